#include "study/engines/quest_plus.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "stimuli/error.h"

namespace stairstep {
namespace {

constexpr double kLargestTable = 1e8;
constexpr double kImpossible = -1e300;

[[noreturn]] void refuse(const std::string& subject, const char* problem) {
    throw InputError("QUEST+ " + subject, problem, "compare the settings with study/engines/quest_plus.h");
}

bool all_finite(std::span<const double> values) {
    return std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
}

void require_valid(const QuestPlusSettings& s) {
    if (s.stimuli.empty()) refuse("stimuli", "must be at least one");
    for (const std::vector<double>& point : s.stimuli) {
        if (point.size() != s.stimuli.front().size() || point.empty()) refuse("stimuli", "must have one dimension all");
        if (!all_finite(point)) refuse("stimuli", "must be finite numbers");
    }
    if (s.outcomes < 2) refuse("outcomes", "must be at least two");
    if (!s.model) refuse("model", "is missing");
    double entries = static_cast<double>(s.stimuli.size()) * s.outcomes;
    bool any_of_interest = false;
    for (const QuestPlusParameter& p : s.parameters) {
        const std::string subject = "parameter " + p.name;
        if (p.values.empty() || !all_finite(p.values)) refuse(subject, "needs values that are finite numbers");
        if (!p.prior.empty()) {
            double sum = 0;
            for (const double weight : p.prior) {
                if (!(weight >= 0)) refuse(subject, "has a prior weight that is no number ≥ 0");
                sum += weight;
            }
            if (p.prior.size() != p.values.size()) refuse(subject, "needs one prior weight for each value");
            if (!(sum > 0) || !std::isfinite(sum)) refuse(subject, "needs prior weights of a finite sum above 0");
        }
        entries *= static_cast<double>(p.values.size());
        any_of_interest |= !p.nuisance;
    }
    if (!any_of_interest) refuse("parameters", "need at least one that is no nuisance");
    if (entries > kLargestTable) refuse("grid", "has more than 10^8 stimuli × parameters × outcomes");
}

/// Σ a·b in four sums, which don't wait for each other.
double dot(std::span<const double> a, std::span<const double> b) {
    double sums[4] = {};
    size_t i = 0;
    for (; i + 4 <= a.size(); i += 4) {
        for (size_t k = 0; k < 4; ++k) sums[k] += a[i + k] * b[i + k];
    }
    for (; i < a.size(); ++i) sums[0] += a[i] * b[i];
    return (sums[0] + sums[1]) + (sums[2] + sums[3]);
}

/// −p·ln p, 0 at 0; rounding may have left p a hair below 0.
double entropy_term(double p) {
    return p > 0 ? -p * std::log(p) : 0;
}

}  // namespace

struct QuestPlus::Tables {
    QuestPlusSettings settings;
    /// Grid points are numbered with nuisance parameters running fastest; a parameter's value index at point c is
    /// (c / stride) % its count of values.
    std::vector<size_t> strides;
    size_t points = 1;
    /// How many points share their parameters of interest.
    size_t nuisance_points = 1;
    /// p(outcome | stimulus, point) at [(stimulus·outcomes + outcome)·points + point].
    std::vector<double> probabilities;
    /// Entropy of the outcome at [stimulus·points + point], where no parameter is a nuisance.
    std::vector<double> entropies;

    explicit Tables(const QuestPlusSettings& s) : settings(s) {
        require_valid(s);
        strides.resize(s.parameters.size());
        for (const bool nuisance : {true, false}) {
            for (size_t p = s.parameters.size(); p-- > 0;) {
                if (s.parameters[p].nuisance != nuisance) continue;
                strides[p] = points;
                points *= s.parameters[p].values.size();
            }
            if (nuisance) nuisance_points = points;
        }
        tabulate();
    }

    size_t value_index(size_t point, size_t parameter) const {
        return point / strides[parameter] % settings.parameters[parameter].values.size();
    }

    void parameters_at(size_t point, std::span<double> parameters) const {
        for (size_t p = 0; p < parameters.size(); ++p) {
            parameters[p] = settings.parameters[p].values[value_index(point, p)];
        }
    }

    void evaluate(std::span<const double> stimulus, std::span<const double> parameters, std::span<double> log_p) const {
        std::fill(log_p.begin(), log_p.end(), std::nan(""));
        settings.model(stimulus, parameters, log_p);
        double sum = 0;
        for (const double l : log_p) sum += std::exp(l);
        if (!(std::abs(sum - 1) < 1e-6)) refuse("model", "gives probabilities that don't sum to 1");
    }

    void tabulate() {
        const size_t outcomes = static_cast<size_t>(settings.outcomes);
        probabilities.resize(settings.stimuli.size() * outcomes * points);
        if (nuisance_points == 1) entropies.resize(settings.stimuli.size() * points);
        std::vector<double> parameters(settings.parameters.size());
        std::vector<double> log_p(outcomes);
        for (size_t c = 0; c < points; ++c) {
            parameters_at(c, parameters);
            for (size_t s = 0; s < settings.stimuli.size(); ++s) {
                evaluate(settings.stimuli[s], parameters, log_p);
                double entropy = 0;
                for (size_t o = 0; o < outcomes; ++o) {
                    const double p = std::exp(log_p[o]);
                    probabilities[(s * outcomes + o) * points + c] = p;
                    entropy += entropy_term(p);
                }
                if (nuisance_points == 1) entropies[s * points + c] = entropy;
            }
        }
    }

    std::span<const double> probabilities_of(size_t stimulus, size_t outcome) const {
        return std::span(probabilities)
            .subspan((stimulus * static_cast<size_t>(settings.outcomes) + outcome) * points, points);
    }
};

QuestPlus::QuestPlus(const QuestPlusSettings& settings) : tables_(std::make_shared<const Tables>(settings)) {
    log_posterior_.assign(tables_->points, 0);
    for (size_t p = 0; p < settings.parameters.size(); ++p) {
        const std::vector<double>& prior = settings.parameters[p].prior;
        if (prior.empty()) continue;
        // A weight of 0 is a value ruled out: its logarithm is −∞, and stays so.
        for (size_t c = 0; c < log_posterior_.size(); ++c) {
            log_posterior_[c] += std::log(prior[tables_->value_index(c, p)]);
        }
    }
    normalise();
}

const std::vector<double>& QuestPlus::stimulus(size_t index) const {
    return tables_->settings.stimuli.at(index);
}

std::vector<double> QuestPlus::expected_entropies() const {
    const Tables& t = *tables_;
    const size_t outcomes = static_cast<size_t>(t.settings.outcomes);
    double entropy_now = 0;
    if (t.nuisance_points == 1) {
        for (const double p : posterior_) entropy_now += entropy_term(p);
    }
    std::vector<double> expected(t.settings.stimuli.size());
    for (size_t s = 0; s < expected.size(); ++s) {
        if (t.nuisance_points == 1) {
            double outcome_entropy = 0;
            double last = 1;
            for (size_t o = 0; o + 1 < outcomes; ++o) {
                const double p = dot(posterior_, t.probabilities_of(s, o));
                outcome_entropy += entropy_term(p);
                last -= p;
            }
            outcome_entropy += entropy_term(last);
            const double given = dot(posterior_, std::span(t.entropies).subspan(s * t.points, t.points));
            expected[s] = entropy_now - (outcome_entropy - given);
            continue;
        }
        for (size_t o = 0; o < outcomes; ++o) {
            const std::span<const double> p = t.probabilities_of(s, o);
            double of_outcome = 0;
            for (size_t c = 0; c < t.points; c += t.nuisance_points) {
                const double joint =
                    dot(std::span(posterior_).subspan(c, t.nuisance_points), p.subspan(c, t.nuisance_points));
                expected[s] += entropy_term(joint);
                of_outcome += joint;
            }
            expected[s] -= entropy_term(of_outcome);
        }
    }
    return expected;
}

size_t QuestPlus::suggest() const {
    const std::vector<double> expected = expected_entropies();
    return static_cast<size_t>(std::min_element(expected.begin(), expected.end()) - expected.begin());
}

void QuestPlus::update(std::span<const double> stimulus, int outcome) {
    const Tables& t = *tables_;
    if (stimulus.size() != t.settings.stimuli.front().size() || !all_finite(stimulus)) {
        refuse("stimulus shown", "must be finite and of the list's dimension");
    }
    if (outcome < 0 || outcome >= t.settings.outcomes) refuse("outcome", "is none of those in the settings");
    std::vector<double> parameters(t.settings.parameters.size());
    std::vector<double> log_p(static_cast<size_t>(t.settings.outcomes));
    std::vector<double> log_likelihoods(t.points);
    // What the points still possible have in common is left out: it may be so large that what was known before would
    // vanish beside it.
    double common = -std::numeric_limits<double>::infinity();
    for (size_t c = 0; c < t.points; ++c) {
        t.parameters_at(c, parameters);
        t.evaluate(stimulus, parameters, log_p);
        log_likelihoods[c] = std::max(log_p[static_cast<size_t>(outcome)], kImpossible);
        if (std::isfinite(log_posterior_[c])) common = std::max(common, log_likelihoods[c]);
    }
    for (size_t c = 0; c < t.points; ++c) log_posterior_[c] += log_likelihoods[c] - common;
    ++trials_;
    normalise();
}

void QuestPlus::normalise() {
    // The largest logarithm is kept at 0, so that the posterior never underflows as a whole.
    const double largest = *std::max_element(log_posterior_.begin(), log_posterior_.end());
    posterior_.resize(log_posterior_.size());
    double mass = 0;
    for (size_t c = 0; c < posterior_.size(); ++c) {
        log_posterior_[c] -= largest;
        posterior_[c] = std::exp(log_posterior_[c]);
        mass += posterior_[c];
    }
    for (double& p : posterior_) p /= mass;
}

std::vector<double> QuestPlus::marginal(size_t parameter) const {
    std::vector<double> probabilities(tables_->settings.parameters.at(parameter).values.size());
    for (size_t c = 0; c < posterior_.size(); ++c) {
        probabilities[tables_->value_index(c, parameter)] += posterior_[c];
    }
    return probabilities;
}

double QuestPlus::mean(size_t parameter) const {
    return dot(marginal(parameter), tables_->settings.parameters[parameter].values);
}

double QuestPlus::sd(size_t parameter) const {
    const std::vector<double> probabilities = marginal(parameter);
    const std::vector<double>& values = tables_->settings.parameters[parameter].values;
    const double centre = dot(probabilities, values);
    double variance = 0;
    for (size_t i = 0; i < values.size(); ++i)
        variance += probabilities[i] * (values[i] - centre) * (values[i] - centre);
    return std::sqrt(variance);
}

std::vector<double> QuestPlus::mode() const {
    const auto best = std::max_element(log_posterior_.begin(), log_posterior_.end());
    std::vector<double> values(tables_->settings.parameters.size());
    tables_->parameters_at(static_cast<size_t>(best - log_posterior_.begin()), values);
    return values;
}

}  // namespace stairstep
