#include "study/trial.h"

namespace stairstep {

std::string_view name(Judgement judgement) {
    return judgement == Judgement::artifact ? "artifact" : "line";
}

std::optional<Judgement> judgement_named(std::string_view text) {
    if (text == "artifact") return Judgement::artifact;
    if (text == "line") return Judgement::line;
    return std::nullopt;
}

}  // namespace stairstep
