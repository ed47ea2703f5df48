#include "stimuli/grid.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "stimuli/error.h"

namespace stairstep {
namespace {

TEST(StimulusGrid, HoldsEachCombinationOnce) {
    const StimulusGrid grid;
    const std::vector<Stimulus> stimuli = stimuli_of(grid);
    // step, stair, line of step, line of stair
    EXPECT_EQ(stimuli.size(), 4 * grid.texels_px.size() * grid.radii_px.size() * grid.contrasts.size());
    std::set<std::string> stems;
    for (const Stimulus& s : stimuli) stems.insert(file_stem(s));
    EXPECT_EQ(stems.size(), stimuli.size());
}

TEST(StimulusGrid, LineMeansTheLineOfWhatIsListed) {
    StimulusGrid grid;
    grid.patterns = {Pattern::stair, Pattern::line};
    for (const Stimulus& s : stimuli_of(grid)) EXPECT_EQ(s.silhouette, Pattern::stair);
    grid.patterns = {Pattern::line};
    const std::vector<Stimulus> both = stimuli_of(grid);
    EXPECT_TRUE(std::any_of(both.begin(), both.end(), [](auto& s) { return s.silhouette == Pattern::step; }));
    EXPECT_TRUE(std::any_of(both.begin(), both.end(), [](auto& s) { return s.silhouette == Pattern::stair; }));
}

TEST(StimulusGrid, SlopesAndPhasesMultiplySampledPatternsAlone) {
    StimulusGrid grid;
    grid.patterns = {Pattern::slope, Pattern::line};
    grid.slopes = {0.25, 0.5};
    grid.phases = {{0, 0}, {0.25, 0}, {0.5, 0.5}};
    grid.texels_px = {10};
    grid.radii_px = {35};
    grid.contrasts = {1};
    const std::vector<Stimulus> stimuli = stimuli_of(grid);
    EXPECT_EQ(stimuli.size(), 2u * 3u + 2u);
    std::set<std::string> stems;
    for (const Stimulus& s : stimuli) stems.insert(file_stem(s));
    EXPECT_EQ(stems.size(), stimuli.size());
    grid.slopes.clear();
    EXPECT_THROW(stimuli_of(grid), InputError);
}

TEST(StimulusGrid, RefusesEmptyAxesRepeatsAndBadValues) {
    StimulusGrid empty;
    empty.radii_px.clear();
    EXPECT_THROW(stimuli_of(empty), InputError);
    StimulusGrid repeated;
    repeated.texels_px = {5, 10, 5};
    EXPECT_THROW(stimuli_of(repeated), InputError);
    StimulusGrid bad;
    bad.contrasts = {1, 2};
    EXPECT_THROW(stimuli_of(bad), InputError);
}

}  // namespace
}  // namespace stairstep
