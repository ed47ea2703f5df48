// Measured transfers as files.
#pragma once

#include <filesystem>
#include <string>

#include "stimuli/transfer.h"

namespace stairstep {

/// A transfer by its name, or from a look-up table: CSV with the columns `level,luminance`, one row a measurement.
/// Levels run from 0 to 1 or from 0 to 255 (to which of them, the last row says), luminance is in any unit and counts
/// relative to its last; both strictly increase. Files are sought relative to `folder`. Throws InputError, which names
/// the line that is wrong.
Transfer read_transfer(const std::string& name_or_file, const std::filesystem::path& folder = {});

/// Keeps a table beside the images it was used for, under the transfer's name, so that the folder explains itself; does
/// nothing for a transfer that is no table. `read_transfer` of that file gives the same transfer. Throws FailureError.
void write_transfer_table(const std::filesystem::path& folder, const Transfer& transfer);

}  // namespace stairstep
