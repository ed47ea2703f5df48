#include "study/design.h"

#include <gtest/gtest.h>

#include <map>
#include <set>

namespace stairstep {
namespace {

TEST(Design, HasTheThesissRounds) {
    const std::vector<Round> rounds = rounds_for(Design(), 0);
    ASSERT_EQ(rounds.size(), 4u);
    std::set<std::pair<Pattern, double>> seen;
    for (const Round& round : rounds) {
        ASSERT_EQ(round.tracks.size(), 4u);
        for (const Condition& track : round.tracks) {
            EXPECT_EQ(track.pattern, round.tracks[0].pattern);
            EXPECT_EQ(track.contrast, round.tracks[0].contrast);
        }
        seen.emplace(round.tracks[0].pattern, round.tracks[0].contrast);
    }
    EXPECT_EQ(seen.size(), 4u);
}

TEST(Design, BalancesTheOrderOfRoundsOverObservers) {
    std::map<std::pair<Pattern, double>, std::map<size_t, int>> places;
    std::map<std::pair<std::pair<Pattern, double>, std::pair<Pattern, double>>, int> follows;
    for (int observer = 0; observer < 8; ++observer) {
        const std::vector<Round> rounds = rounds_for(Design(), observer);
        const auto key = [&](size_t i) { return std::pair(rounds[i].tracks[0].pattern, rounds[i].tracks[0].contrast); };
        for (size_t i = 0; i < 4; ++i) ++places[key(i)][i];
        for (size_t i = 0; i < 3; ++i) ++follows[{key(i), key(i + 1)}];
    }
    for (const auto& [round, counts] : places) {
        EXPECT_EQ(counts.size(), 4u);
        for (const auto& [place, count] : counts) EXPECT_EQ(count, 2);
    }
    EXPECT_EQ(follows.size(), 12u);
    for (const auto& [pair, count] : follows) EXPECT_EQ(count, 2);
}

TEST(Design, GuessesThreeTexels) {
    EXPECT_NEAR(std::get<QuestSettings>(engine_settings(Design())).guess, -std::log10(3), 1e-15);
}

}  // namespace
}  // namespace stairstep
