#include "study/trials_csv.h"

#include <chrono>
#include <cmath>
#include <cstdio>
#include <limits>

#include "stimuli/error.h"
#include "stimuli/io/csv.h"
#include "stimuli/io/utf8.h"
#include "stimuli/number.h"

namespace stairstep {
namespace {

/// Unix time as ISO 8601 in UTC, to the millisecond.
std::string iso_time(double unix_s) {
    using namespace std::chrono;
    const sys_time<milliseconds> time{milliseconds(std::llround(unix_s * 1000))};
    const auto day = floor<days>(time);
    const year_month_day date(day);
    const hh_mm_ss clock(time - day);
    char text[40];
    std::snprintf(text, sizeof text, "%04d-%02u-%02uT%02d:%02d:%02d.%03dZ", static_cast<int>(date.year()),
                  static_cast<unsigned>(date.month()), static_cast<unsigned>(date.day()),
                  static_cast<int>(clock.hours().count()), static_cast<int>(clock.minutes().count()),
                  static_cast<int>(clock.seconds().count()), static_cast<int>(clock.subseconds().count()));
    return text;
}

/// Turns a table's fields into trials, by columns found once.
class TrialReader {
  public:
    explicit TrialReader(const CsvTable& table)
        : table_(table),
          observer_(table.column("observer")),
          pattern_(table.column("pattern")),
          kernel_(table.column("kernel")),
          contrast_(table.column("contrast")),
          texel_px_(table.column("texel_px")),
          radius_px_(table.column("radius_px")),
          stimulus_(table.column("stimulus")),
          response_(table.column("response")) {}

    Trial trial(size_t row) const {
        Trial trial;
        trial.observer = utf8(row, observer_);
        if (trial.observer.empty()) table_.reject(row, observer_, "is empty", "name the observer");
        trial.condition = {pattern(row), kernel(row), contrast(row), length(row, texel_px_)};
        trial.radius_px = length(row, radius_px_);
        trial.stimulus = judgement(row, stimulus_);
        trial.response = judgement(row, response_);
        if (const auto column = table_.find_column("study")) trial.study = utf8(row, *column);
        trial.suggested_radius_px = optional_number(row, "suggested_radius_px", trial.radius_px);
        trial.response_time_s = optional_number(row, "response_time_s", 0);
        trial.session = optional_count(row, "session");
        trial.presentation = optional_count(row, "presentation");
        read_optional_name(row, "kind", trial.kind, trial_kind_named, "write main, practice or catch");
        read_optional_name(row, "task", trial.task, task_named, "write yes-no or 2afc");
        trial.is_void = optional_number(row, "void", 0) != 0;
        trial.round = optional_count(row, "round");
        trial.track = optional_count(row, "track");
        // Practice and catch trials have no number in their track.
        trial.trial = trial.kind == TrialKind::main ? optional_count(row, "trial") : 0;
        return trial;
    }

  private:
    Pattern pattern(size_t row) const {
        const std::string& text = table_.text(row, pattern_);
        if (text == name(Pattern::step)) return Pattern::step;
        if (text == name(Pattern::stair)) return Pattern::stair;
        table_.reject(row, pattern_, "\"" + text + "\" is no pattern of a track", "write step or stair");
    }

    KernelShape kernel(size_t row) const {
        if (const auto shape = kernel_shape_named(table_.text(row, kernel_))) return *shape;
        table_.reject(row, kernel_, "\"" + table_.text(row, kernel_) + "\" is no kernel",
                      "write box, disk, gaussian or poisson");
    }

    double contrast(size_t row) const {
        const double value = positive(row, contrast_);
        if (value > 1) table_.reject(row, contrast_, "must be at most 1", "write 0.5 for 50 %");
        return value;
    }

    double positive(size_t row, size_t column) const {
        const double value = table_.number(row, column);
        if (!(value > 0)) table_.reject(row, column, "must be above 0", "write for example 10");
        return value;
    }

    /// In the range of a normal float, so that ratios of two are finite, and none is 0.
    double length(size_t row, size_t column) const {
        using Limits = std::numeric_limits<float>;
        const double value = positive(row, column);
        if (value < Limits::min() || value > Limits::max()) {
            table_.reject(row, column, "is out of range", "write a number of pixels, for example 10");
        }
        return value;
    }

    /// Names go into JSON, which holds nothing else.
    const std::string& utf8(size_t row, size_t column) const {
        if (!is_utf8(table_.text(row, column))) {
            table_.reject(row, column, "is not UTF-8", "save the table in that encoding");
        }
        return table_.text(row, column);
    }

    Judgement judgement(size_t row, size_t column) const {
        if (const auto judgement = judgement_named(table_.text(row, column))) return *judgement;
        table_.reject(row, column, "\"" + table_.text(row, column) + "\" is no judgement", "write artifact or line");
    }

    double optional_number(size_t row, const char* column_name, double otherwise) const {
        const auto column = table_.find_column(column_name);
        return column ? table_.number(row, *column) : otherwise;
    }

    template <typename T, typename Parse>
    void read_optional_name(size_t row, const char* column_name, T& value, const Parse& parse,
                            const char* remedy) const {
        const auto column = table_.find_column(column_name);
        if (!column) return;
        const auto parsed = parse(table_.text(row, *column));
        if (!parsed) table_.reject(row, *column, "\"" + table_.text(row, *column) + "\" is unknown", remedy);
        value = *parsed;
    }

    int optional_count(size_t row, const char* column_name) const {
        const auto column = table_.find_column(column_name);
        if (!column) return 1;
        const double value = table_.number(row, *column);
        if (!(value >= 1 && value <= 1e9) || value != std::floor(value)) {
            table_.reject(row, *column, "must be a whole number from 1 on",
                          "number sessions, rounds, tracks and trials from 1");
        }
        return static_cast<int>(value);
    }

    const CsvTable& table_;
    size_t observer_, pattern_, kernel_, contrast_, texel_px_, radius_px_, stimulus_, response_;
};

}  // namespace

std::string trials_csv(const std::vector<Trial>& trials) {
    CsvWriter csv;
    csv.row({"study",
             "observer",
             "session",
             "round",
             "track",
             "trial",
             "pattern",
             "kernel",
             "contrast",
             "texel_px",
             "suggested_radius_px",
             "radius_px",
             "stimulus",
             "response",
             "correct",
             "response_time_s",
             "shown_at",
             "dropped_frames",
             "presentation",
             "kind",
             "task",
             "void"});
    for (const Trial& t : trials) {
        csv.row({t.study,
                 t.observer,
                 std::to_string(t.session),
                 std::to_string(t.round),
                 std::to_string(t.track),
                 std::to_string(t.trial),
                 std::string(name(t.condition.pattern)),
                 std::string(name(t.condition.kernel)),
                 format_number(t.condition.contrast),
                 format_number(t.condition.texel_px),
                 format_number(t.suggested_radius_px),
                 format_number(t.radius_px),
                 std::string(name(t.stimulus)),
                 std::string(name(t.response)),
                 t.correct() ? "1" : "0",
                 format_fixed(t.response_time_s, 4),
                 iso_time(t.shown_at_s),
                 std::to_string(t.dropped_frames),
                 std::to_string(t.presentation),
                 std::string(name(t.kind)),
                 std::string(name(t.task)),
                 t.is_void ? "1" : "0"});
    }
    return csv.text();
}

std::vector<Trial> read_trials_csv(const std::filesystem::path& path) {
    const CsvTable table = CsvTable::read(path);
    const TrialReader reader(table);
    if (table.row_count() == 0) throw InputError(path.string(), "holds no trial", "export a study that has some");
    std::vector<Trial> trials;
    trials.reserve(table.row_count());
    for (size_t row = 0; row < table.row_count(); ++row) trials.push_back(reader.trial(row));
    return trials;
}

}  // namespace stairstep
