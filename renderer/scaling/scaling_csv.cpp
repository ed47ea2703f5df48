#include "renderer/scaling/scaling_csv.h"

#include "stimuli/io/csv.h"
#include "stimuli/number.h"

namespace stairstep::scaling {

std::string scaling_csv(const std::vector<AxisCurves>& axes, const Setting& setting) {
    CsvWriter csv;
    std::vector<std::string> fields{"axis", "value", "technique", "size"};
    for (const Part& part : parts()) fields.push_back(std::string(part.name) + "_ms");
    for (const char* name : {"texels", "taps", "gpu_frame_ms", "width", "height", "picture_width", "picture_height",
                             "frames", "renderer", "context"}) {
        fields.emplace_back(name);
    }
    csv.row(fields);
    for (const AxisCurves& axis : axes) {
        for (const Curve& curve : axis.curves) {
            for (const Point& point : curve.points) {
                fields = {axis.axis, format_number(point.value), curve.configuration.technique,
                          size_of(curve.configuration)};
                for (const Part& part : parts()) fields.push_back(format_number(part.ms(point.times)));
                for (const double number :
                     {point.texels(), static_cast<double>(curve.configuration.taps), point.times.frame.gpu_ms,
                      static_cast<double>(point.map_width), static_cast<double>(point.map_height),
                      static_cast<double>(point.picture_width), static_cast<double>(point.picture_height),
                      static_cast<double>(setting.frames)}) {
                    fields.push_back(format_number(number));
                }
                fields.push_back(setting.renderer);
                fields.push_back(setting.context);
                csv.row(fields);
            }
        }
    }
    return csv.text();
}

std::string size_of(const bench::Configuration& configuration) {
    if (configuration.entry == "none") return "none";
    return configuration.side ? std::to_string(*configuration.side) : "auto";
}

}  // namespace stairstep::scaling
