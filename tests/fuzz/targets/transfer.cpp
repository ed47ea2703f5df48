#include <cmath>

#include "stimuli/io/csv.h"
#include "stimuli/io/transfer_file.h"
#include "stimuli/number.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

std::string table_of(const Transfer& transfer) {
    CsvWriter csv;
    csv.row({"level", "luminance"});
    for (const Transfer::Point& point : transfer.points()) {
        csv.row({format_number(point.level), format_number(point.luminance)});
    }
    return csv.text();
}

}  // namespace

void run_transfer(std::string_view input) {
    Transfer transfer;
    if (!accepted([&] { transfer = read_transfer(InputFile(input).path().string()); })) return;
    const auto& points = transfer.points();
    require(points.size() >= 2 && points.size() <= input.size(), "a table has two points, and no more than bytes");
    require(points.front().level == 0 && points.back().level == 1 && points.back().luminance == 1, "it ends at 1");
    for (size_t i = 1; i < points.size(); ++i) {
        require(points[i].level > points[i - 1].level && points[i].luminance > points[i - 1].luminance, "it increases");
    }
    double before = 0;
    for (double luminance = 0; luminance <= 1; luminance += 0.125) {
        const double level = transfer.encode(luminance);
        require(level >= before && level <= 1, "what is brighter is stored no lower");
        const double shown = transfer.decode(level);
        require(shown >= 0 && shown <= 1, "a luminance lies in [0, 1]");
        before = level;
    }
    const Transfer again = read_transfer(InputFile(table_of(transfer)).path().string());
    require(again.name() == transfer.name(), "a table reads back as it was written");
}

}  // namespace stairstep::fuzz
