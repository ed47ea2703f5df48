#include "study/pseudonyms.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <set>

namespace stairstep {
namespace {

std::vector<SessionRecord> sessions_of(const std::vector<std::string>& observers, const std::string& kind = "person") {
    std::vector<SessionRecord> sessions;
    for (const std::string& observer : observers) {
        sessions.push_back({static_cast<int>(sessions.size()) + 1, observer, 0, 1, kind, "{}", std::nullopt});
    }
    return sessions;
}

using Names = std::map<std::string, std::string>;

TEST(Pseudonyms, KeepNumbersThatStandForAPersonAndNothingElse) {
    for (const char* kept : {"sim01", "sim100", "sub-07", "P7", "p_12", "VP0123", "7", "042", "Subject-3"}) {
        EXPECT_TRUE(is_pseudonym(kept)) << kept;
    }
    for (const char* name : {"", "Anna", "anna2", "Max1", "Anna Meier", "1985", "12345678", "p12345", "sub-", "p-",
                             "sub-07 Anna", "sub--7", "sim 1", "Öz", "p7\n", "-7", "7p"}) {
        EXPECT_FALSE(is_pseudonym(name)) << name;
    }
}

TEST(Pseudonyms, NumberPeopleByTheirFirstSession) {
    EXPECT_EQ(pseudonyms(sessions_of({"Zoe", "sub-07", "Anna", "Zoe", "Bo"})),
              (Names{{"Zoe", "p01"}, {"sub-07", "sub-07"}, {"Anna", "p03"}, {"Bo", "p04"}}));
    EXPECT_EQ(pseudonyms(sessions_of({"ideal observer", "sim02"}, "simulated")),
              (Names{{"ideal observer", "ideal observer"}, {"sim02", "sim02"}}));
}

TEST(Pseudonyms, ThatAreTakenMakeTheNextOneFree) {
    EXPECT_EQ(pseudonyms(sessions_of({"P02", "Anna", "Bo"})), (Names{{"P02", "P02"}, {"Anna", "p03"}, {"Bo", "p04"}}));
    // Anna was exported as p01 before somebody chose that ID.
    EXPECT_EQ(pseudonyms(sessions_of({"Anna", "p01"})), (Names{{"Anna", "p01"}, {"p01", "p02"}}));
}

RC_GTEST_PROP(Pseudonyms, AreDistinctStableAndNoNames, (const std::vector<uint8_t>& choices)) {
    const std::vector<std::string> pool{"Anna", "Bo", "p01", "P01", "p02",  "p03",  "sub-1",
                                        "anna", "Öz", "",    "7",   "sim1", "SIM1", "Eva3"};
    std::vector<std::string> observers;
    for (const uint8_t choice : choices) observers.push_back(pool[choice % pool.size()]);
    const Names all = pseudonyms(sessions_of(observers));
    std::set<std::string> distinct;
    for (const auto& [observer, pseudonym] : all) {
        RC_ASSERT(is_pseudonym(pseudonym));
        std::string lower = pseudonym;
        std::transform(lower.begin(), lower.end(), lower.begin(), [](unsigned char c) { return std::tolower(c); });
        RC_ASSERT(distinct.insert(lower).second);
    }
    // An earlier export, with fewer sessions, called its observers the same.
    for (size_t n = 0; n <= observers.size(); ++n) {
        for (const auto& [observer, pseudonym] : pseudonyms(sessions_of({observers.begin(), observers.begin() + n}))) {
            RC_ASSERT(all.at(observer) == pseudonym);
        }
    }
}

}  // namespace
}  // namespace stairstep
