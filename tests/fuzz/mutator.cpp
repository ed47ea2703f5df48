#include "tests/fuzz/mutator.h"

#include <algorithm>
#include <cctype>
#include <string_view>
#include <vector>

namespace stairstep::fuzz {
namespace {

/// Numbers, and what stands where numbers are expected.
constexpr std::string_view kEdges[] = {"0",
                                       "-0",
                                       "-1",
                                       "1",
                                       "1e-320",
                                       "2.5e-324",
                                       "1e38",
                                       "1e39",
                                       "1.7976931348623157e308",
                                       "1e999",
                                       "-1e9",
                                       "nan",
                                       "inf",
                                       "2147483647",
                                       "2147483648",
                                       "18446744073709551615",
                                       "0.1",
                                       "1e-9",
                                       "255",
                                       "",
                                       "null"};

/// A place in the text, its end included.
size_t place_in(const std::string& text, Random& random) {
    return random.below(text.size() + 1);
}

/// A length that is short more often than long, up to the text's end.
size_t length_from(const std::string& text, size_t begin, Random& random) {
    const size_t left = text.size() - begin;
    return std::min<size_t>(left, random.below(size_t{1} << random.below(8)) + 1);
}

bool is_number_part(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) || c == '.' || c == '-' || c == '+' || c == 'e';
}

/// The numeral at or after a place becomes one of kEdges.
void replace_number(std::string& text, Random& random) {
    const auto digit = [](char c) { return std::isdigit(static_cast<unsigned char>(c)) != 0; };
    const auto found = std::find_if(text.begin() + static_cast<long>(place_in(text, random)), text.end(), digit);
    if (found == text.end()) return;
    const auto end = std::find_if_not(found, text.end(), is_number_part);
    auto begin = found;
    while (begin != text.begin() && is_number_part(*(begin - 1))) --begin;
    text.replace(begin, end, kEdges[random.below(std::size(kEdges))]);
}

void mutate(std::string& text, std::span<const std::string> inputs, Random& random) {
    const size_t begin = place_in(text, random);
    const size_t length = length_from(text, begin, random);
    switch (random.below(8)) {
        case 0:
            if (begin < text.size()) text[begin] = static_cast<char>(text[begin] ^ 1 << random.below(8));
            break;
        case 1:
            if (begin < text.size()) text[begin] = static_cast<char>(random.below(256));
            break;
        case 2: text.erase(begin, length); break;
        case 3: text.insert(begin, text.substr(begin, length)); break;
        case 4: {
            const std::string& other = inputs[random.below(inputs.size())];
            const size_t from = place_in(other, random);
            text.replace(begin, length, other.substr(from, length_from(other, from, random)));
            break;
        }
        case 5: text.resize(begin); break;
        default: replace_number(text, random); break;
    }
}

}  // namespace

std::string mutation(std::span<const std::string> inputs, Random& random) {
    std::string text = inputs[random.below(inputs.size())];
    for (uint64_t left = random.below(4) + 1; left > 0; --left) mutate(text, inputs, random);
    text.resize(std::min(text.size(), kLongestMutation));
    return text;
}

}  // namespace stairstep::fuzz
