#include "study/pseudonyms.h"

#include <algorithm>
#include <array>
#include <cstdio>
#include <set>

namespace stairstep {
namespace {

constexpr std::array kWords{"p", "s", "sub", "subj", "subject", "sim", "obs", "observer", "participant", "id", "vp"};

std::string lower_case(std::string_view text) {
    std::string lower(text);
    std::transform(lower.begin(), lower.end(), lower.begin(),
                   [](char c) { return c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c; });
    return lower;
}

std::string numbered(size_t number) {
    char text[24];
    std::snprintf(text, sizeof text, "p%02zu", number);
    return text;
}

}  // namespace

bool is_pseudonym(std::string_view observer) {
    const std::string text = lower_case(observer);
    const size_t digits = text.size() - (text.find_last_not_of("0123456789") + 1);
    std::string word = text.substr(0, text.size() - digits);
    if (digits == 0) return false;
    // A bare number of four digits may be a year of birth.
    if (word.empty()) return digits <= 3;
    if (word.back() == '-' || word.back() == '_') word.pop_back();
    return digits <= 4 && std::find(kWords.begin(), kWords.end(), word) != kWords.end();
}

std::map<std::string, std::string> pseudonyms(const std::vector<SessionRecord>& sessions) {
    std::map<std::string, std::string> result;
    std::set<std::string> taken;
    for (const SessionRecord& session : sessions) {
        if (result.contains(session.observer)) continue;
        size_t number = result.size() + 1;
        const bool is_kept = session.observer_kind == "simulated" || is_pseudonym(session.observer);
        std::string pseudonym = is_kept ? session.observer : numbered(number);
        while (!taken.insert(lower_case(pseudonym)).second) pseudonym = numbered(number++);
        result[session.observer] = pseudonym;
    }
    return result;
}

}  // namespace stairstep
