#include <cmath>
#include <memory>
#include <optional>

#include "stimuli/io/csv.h"
#include "study/answer_stream.h"
#include "study/engines/psychtoolbox_quest.h"
#include "study/engines/quest.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

using File = std::unique_ptr<std::FILE, int (*)(std::FILE*)>;

File opened(const InputFile& input) {
    return {std::fopen(input.path().c_str(), "rb"), std::fclose};
}

/// What is in the columns intensity and response, read at once.
std::vector<std::pair<std::string, std::string>> columns_of(const std::string& text) {
    const CsvTable table = CsvTable::parse(text, "table");
    const size_t intensity = table.column("intensity");
    const size_t response = table.column("response");
    std::vector<std::pair<std::string, std::string>> rows;
    for (size_t row = 0; row < table.row_count(); ++row) {
        rows.emplace_back(table.text(row, intensity), table.text(row, response));
    }
    return rows;
}

/// The same, read row by row.
std::vector<std::pair<std::string, std::string>> streamed_columns_of(const InputFile& input) {
    const File file = opened(input);
    CsvStream stream(file.get(), "stream");
    const size_t intensity = stream.column("intensity");
    const size_t response = stream.column("response");
    std::vector<std::pair<std::string, std::string>> rows;
    while (stream.next()) rows.emplace_back(stream.text(intensity), stream.text(response));
    return rows;
}

}  // namespace

void run_answers(std::string_view input) {
    const InputFile input_file(input);
    std::vector<std::pair<std::string, std::string>> at_once;
    std::vector<std::pair<std::string, std::string>> streamed;
    const bool good = accepted([&] { at_once = columns_of(std::string(input)); });
    const bool streams = accepted([&] { streamed = streamed_columns_of(input_file); });
    // The stream alone has a longest line.
    if (input.size() < 1 << 20) require(good == streams && at_once == streamed, "both readers of CSV read the same");

    Quest quest({.grain = 0.05});
    PsychtoolboxQuest psychtoolbox({.guess = 0, .guess_sd = 2, .grain = 0.05, .range = 5});
    const bool taken = accepted([&] {
        const File file = opened(input_file);
        AnswerStream answers(file.get(), "answers");
        while (const auto answer = answers.next()) {
            require(std::isfinite(answer->intensity), "an intensity is finite");
            quest.update(answer->intensity, answer->correct);
            psychtoolbox.update(answer->intensity, answer->correct);
        }
    });
    require(!taken || streams, "what can't be read as CSV has no answers");
    require(quest.trials() == psychtoolbox.trials(), "both engines take the same answers");
    require(std::abs(quest.mean()) <= 2.5 + 1e-9, "the mean lies on the grid");
    require(quest.sd() >= 0 && quest.sd() <= 5, "the SD is no larger than the grid");
    require(std::isfinite(quest.suggest()) && std::isfinite(quest.quantile(0.5)), "the next trial is somewhere");
    // With delta above 0 nothing can make Psychtoolbox's posterior vanish in so few trials.
    if (psychtoolbox.trials() < 50) require(std::abs(psychtoolbox.mean()) <= 2.5 + 1e-9, "the mean lies on the grid");
}

}  // namespace stairstep::fuzz
