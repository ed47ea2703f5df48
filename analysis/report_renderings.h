// Sections of the report about other stages: what observers judge, and what the law saves on a model.
#pragma once

#include <filesystem>
#include <string>

namespace stairstep {

/// HTML around a contact sheet of stairstep-stimuli. Throws InputError for what is no PNG.
std::string contact_sheet_section(const std::string& path);

/// HTML of stats.json of stairstep-render; pictures are looked for beside it. Throws InputError for a file that is something else.
std::string renderings_section(const std::filesystem::path& stats_path);

}  // namespace stairstep
