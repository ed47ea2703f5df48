#include "renderer/scene_archive.h"
#include "tests/fuzz/sound_scene.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {

void run_archive(std::string_view input) {
    ImportedScene imported;
    try {
        imported = scene_from_archive(input);
    } catch (const Violation&) {
        throw;
    } catch (const std::runtime_error&) {
        return;
    }
    require_sound(imported);
    require(archive_of(imported) == input, "a scene has one archive");
}

}  // namespace stairstep::fuzz
