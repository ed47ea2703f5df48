#include "renderer/bench/configuration.h"

#include <gtest/gtest.h>
#include <rapidcheck.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

#include "renderer/techniques/techniques.h"

namespace stairstep::bench {
namespace {

bool contains(const std::vector<Configuration>& list, const Configuration& one) {
    return std::find(list.begin(), list.end(), one) != list.end();
}

TEST(Configurations, CrossTechniquesSizesAndTaps) {
    const std::vector<Configuration> list = all_configurations();
    // 6 sizes of hard, exact, levels, vsm, esm, of hard and exact under a warp, and of four filters with 3 numbers of taps; of two, 9
    // ways to leave out less or more, and of two fixed ones one.
    EXPECT_EQ(list.size(), 1u + 7 * 6 + 4 * 6 * 3 + 2 * 10 + 2);
    std::set<std::string> labels;
    for (const Configuration& one : list) {
        EXPECT_TRUE(labels.insert(label(one)).second) << label(one);
        EXPECT_NO_THROW(technique_named(one.entry));
    }
}

TEST(Configurations, HoldWhatTheBarsAreAbout) {
    for (const auto& list : {all_configurations(), quick_configurations()}) {
        for (const Configuration& one : {auto_pcf(), fixed_pcf(), auto_pcss(), fixed_pcss()}) {
            EXPECT_TRUE(contains(list, one)) << label(one);
        }
    }
    EXPECT_EQ(label(fixed_pcf()), "pcf-rotated 4096, 25 taps");
    EXPECT_EQ(label(fixed_pcss()), "pcss 4096, 25+25 taps");
    EXPECT_EQ(label(auto_pcss()), "pcss-levels auto");
}

TEST(Configurations, OfAWarpAreWhatTheyAreWithoutIt) {
    for (const Configuration& one : all_configurations()) {
        EXPECT_EQ(one.warp == Warp::lispsm, one.technique.ends_with("-lispsm")) << label(one);
        if (one.warp == Warp::none) continue;
        Configuration plain = one;
        plain.warp = Warp::none;
        EXPECT_NE(one, plain);
        plain.technique = one.entry == "hard" ? "hard" : "pcf-exact";
        EXPECT_TRUE(contains(all_configurations(), plain)) << label(one);
        EXPECT_EQ(truth_of(one), truth_of(plain));
    }
}

TEST(Configurations, AreMeasuredAgainstWhatTheySample) {
    EXPECT_EQ(truth_of(auto_pcf()), TruthKind::box_filter);
    EXPECT_EQ(truth_of(fixed_pcf()), TruthKind::disk_filter);
    EXPECT_EQ(truth_of(auto_pcss()), TruthKind::area_light);
    EXPECT_EQ(truth_of(fixed_pcss()), TruthKind::area_light);
    for (const char* technique : {"vsm", "esm"}) {
        const Configuration prefiltered{technique, technique, FilterMode::automatic, std::nullopt, 0};
        EXPECT_EQ(truth_of(prefiltered), TruthKind::box_filter);
        EXPECT_EQ(baseline_of(prefiltered), fixed_pcf());
        EXPECT_TRUE(contains(all_configurations(), prefiltered));
    }
}

RC_GTEST_PROP(Groups, HoldEachConfigurationAndItsBaseline, ()) {
    std::vector<Configuration> list;
    for (const Configuration& one : all_configurations()) {
        if (*rc::gen::arbitrary<bool>()) list.push_back(one);
    }
    const double most_bytes = *rc::gen::inRange(1, 4096) * 1024.0 * 1024;
    const int largest_size = *rc::gen::inRange(1, 8192);
    size_t found = 0;
    for (const auto& group : groups_of(list, most_bytes, largest_size)) {
        double bytes = 0;
        std::set<std::string> labels;
        size_t others = 0;
        for (const Configuration& one : group) {
            bytes += map_bytes(one, largest_size);
            others += one != baseline_of(one);
            RC_ASSERT(labels.insert(label(one)).second);
            RC_ASSERT(contains(group, baseline_of(one)));
        }
        RC_ASSERT(bytes <= most_bytes || others <= 1u);
        found += others;
    }
    // No other is measured twice.
    RC_ASSERT(found == static_cast<size_t>(std::count_if(list.begin(), list.end(), [](const Configuration& one) {
                  return one != baseline_of(one);
              })));
}

}  // namespace
}  // namespace stairstep::bench
