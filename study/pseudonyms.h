// Pseudonyms: what an export calls the observers, so that names which someone typed stay in the database.
//
// An ID that says nothing of a person is kept: a simulated observer's, a bare number of up to three digits, and one of the
// words in use for participants (p, s, sub, subj, subject, sim, obs, observer, participant, id, vp) with a number of up to
// four digits, as in "sim01", "P7", "sub-07". All others become p01, p02, …, by their place in the order of the first sessions
// of all observers; where an earlier observer is called that already, by the next number that is free. Upper and lower case
// count as the same.
//
// Sessions are only ever added to a study, and a pseudonym depends on those before it alone: an observer has the same one in
// every export of a study. Nothing is computed from the name itself, so that it can't be found by trying names; who may read
// the database sees both in `stairstep-study status`.
#pragma once

#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "study/store.h"

namespace stairstep {

/// Whether an ID looks like a number that stands for a person, as above: "sub-07" does, "anna2" and "12345678" don't.
bool is_pseudonym(std::string_view observer);

/// The pseudonym of each observer, by observer; `sessions` in the order of their numbers.
std::map<std::string, std::string> pseudonyms(const std::vector<SessionRecord>& sessions);

}  // namespace stairstep
