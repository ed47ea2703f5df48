#include "renderer/stress/stress_job.h"

#include <algorithm>
#include <map>
#include <set>

#include "renderer/stress/stress_page.h"
#include "renderer/stress/stress_table.h"
#include "renderer/techniques/techniques.h"
#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/progress.h"
#include "stimuli/number.h"

namespace stairstep::stress {
namespace {

using nlohmann::ordered_json;

std::vector<const TechniqueEntry*> entries_of(const StressJob& job) {
    if (job.techniques.empty()) throw InputError("--techniques", "is empty", "use for example hard,pcf");
    std::set<std::string> seen;
    std::vector<const TechniqueEntry*> entries;
    for (const std::string& name : job.techniques) {
        if (!seen.insert(name).second) {
            throw InputError("--techniques", "\"" + name + "\" is listed twice", "list it once");
        }
        entries.push_back(&technique_named(name));
    }
    return entries;
}

/// Leaves the conditions of these kinds; all where there are none.
void keep_only(std::vector<Condition>& conditions, const std::vector<std::string>& kinds) {
    if (kinds.empty()) return;
    std::string there_are;
    std::set<std::string> known;
    for (const Condition& one : conditions) {
        if (known.insert(one.what).second) there_are += (there_are.empty() ? "" : "; ") + one.what;
    }
    for (const std::string& kind : kinds) {
        if (!known.contains(kind)) {
            throw InputError("--only", "\"" + kind + "\" is no kind of condition here", "use some of: " + there_are);
        }
    }
    std::erase_if(conditions, [&](const Condition& one) { return std::ranges::find(kinds, one.what) == kinds.end(); });
}

ordered_json value_or_null(const std::optional<double>& value) {
    return value ? ordered_json(*value) : ordered_json(nullptr);
}

ordered_json row_of(const Condition& condition, const Measurement& one) {
    const bool compared = outcome_of(one) == "drawn" && condition.course == Course::picture;
    ordered_json row{{"condition", condition.what},
                     {"value", condition.value},
                     {"technique", one.technique},
                     {"outcome", outcome_of(one)}};
    row["error_rmse"] = compared ? ordered_json(one.error_rmse) : ordered_json(nullptr);
    row["error_max"] = compared ? ordered_json(one.error_max) : ordered_json(nullptr);
    row["nan_pixels"] = one.nan_pixels;
    row["gl_errors"] = one.gl_errors;
    row["acne_share"] = value_or_null(one.acne_share);
    row["detachment_texels"] = value_or_null(one.detachment_texels);
    row["drift"] = value_or_null(one.drift);
    row["growth_kib"] = value_or_null(one.growth_kib);
    row["late_growth_kib"] = value_or_null(one.late_growth_kib);
    row["message"] = one.failure + one.refusal;
    return row;
}

/// All techniques under one condition; truths are shared among them.
ConditionResult measured(const Condition& condition, const std::vector<const TechniqueEntry*>& entries,
                         const MeasurementSettings& settings, Progress& progress) {
    ConditionResult result{condition, {}};
    std::map<TruthOf, std::vector<float>> truths;
    for (const TechniqueEntry* entry : entries) {
        const TruthOf kind = truth_for(std::string(entry->name));
        if (condition.course == Course::picture && !truths.contains(kind)) {
            truths[kind] =
                true_visibility(condition.stage, kind, light_plane_radius(condition), settings.width, settings.height);
        }
        result.measurements.push_back(measure(condition, *entry, settings, truths[kind]));
        progress.advance(condition.steps);
    }
    return result;
}

}  // namespace

ordered_json run_stress(const StressJob& job) {
    const std::vector<const TechniqueEntry*> entries = entries_of(job);
    std::vector<Condition> conditions = all_conditions(job.quick, job.long_run);
    if (!job.courses) std::erase_if(conditions, [](const Condition& c) { return c.course != Course::picture; });
    keep_only(conditions, job.only);
    make_output_folder(job.out);
    for (const char* file : {"stress.csv", "stress.md", "index.html"}) OutputFile probe(job.out / file);
    const auto context = gl::make_context(job.context);
    const Setting setting{gl::renderer_name(), std::string(gl::name(job.context)), job.measurement.width,
                          job.measurement.height};
    long steps = 0;
    for (const Condition& condition : conditions) steps += condition.steps * static_cast<long>(entries.size());
    std::vector<ConditionResult> results;
    {
        Progress progress("measuring", steps);
        for (const Condition& condition : conditions) {
            results.push_back(measured(condition, entries, job.measurement, progress));
        }
    }
    write_file(job.out / "stress.csv", stress_csv(results, setting));
    write_file(job.out / "stress.md", stress_table(results));
    write_file(job.out / "index.html", stress_page(results, setting));

    ordered_json json{{"program", "stairstep-render " STAIRSTEP_VERSION},
                      {"renderer", setting.renderer},
                      {"context", setting.context},
                      {"out", job.out.string()},
                      {"broken", broken_rows(results)}};
    json["rows"] = ordered_json::array();
    for (const ConditionResult& result : results) {
        for (const Measurement& one : result.measurements) json["rows"].push_back(row_of(result.condition, one));
    }
    return json;
}

std::string summary_of(const ordered_json& result) {
    std::string text;
    std::string before;
    for (const ordered_json& row : result["rows"]) {
        const std::string title = row["condition"].get<std::string>() + ", " + row["value"].get<std::string>();
        if (title != before) text += title + "\n";
        before = title;
        const auto add = [&](const char* key, const char* label, int decimals) {
            if (!row[key].is_null()) text += std::string("  ") + label + " " + format_fixed(row[key], decimals);
        };
        text += "  " + row["technique"].get<std::string>();
        if (row["outcome"] != "drawn") {
            text += "  " + row["outcome"].get<std::string>() + ": " + row["message"].get<std::string>();
        }
        add("error_rmse", "error", 4);
        add("acne_share", "acne", 4);
        add("detachment_texels", "detachment", 2);
        add("drift", "drift", 4);
        add("growth_kib", "growth KiB", 0);
        add("late_growth_kib", "late growth KiB", 0);
        if (row["nan_pixels"] != 0) text += "  NaN pixels " + std::to_string(row["nan_pixels"].get<size_t>());
        if (row["gl_errors"] != 0) text += "  GL errors " + std::to_string(row["gl_errors"].get<size_t>());
        text += "\n";
    }
    const std::filesystem::path out = result["out"].get<std::string>();
    return text + std::to_string(result["broken"].get<size_t>()) + " rows with NaN, errors of GL or failures\n" +
           (out / "index.html").string() + "\n";
}

}  // namespace stairstep::stress
