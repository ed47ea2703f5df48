// A study's database as a file: made, opened to read, opened to write. The ways differ, and each has its traps.
//
// Made: under another name first, so that the file is there whole or not at all, and never in place of another. Written: WAL
// with synchronous FULL, so that a commit is on the disk when it returns. Read: without changing anything, whatever may or
// may not be written there; an older version is read from a copy in memory.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <filesystem>
#include <functional>
#include <string>

namespace stairstep {

/// Where `:memory:` stands for a path, the database is gone with its connection.
bool is_in_memory(const std::filesystem::path& path);

/// Turns what SQLite throws into InputError (damaged, refused values) or FailureError (the disk, permissions, another
/// process); both name the database.
[[noreturn]] void rethrow(const std::filesystem::path& path, const SQLite::Exception& e);

/// A new database with this version's schema, opened to write. `fill` runs in the transaction that makes the schema. Throws
/// InputError where something of that name exists, FailureError where there is no room.
SQLite::Database make_database(const std::filesystem::path& path, const std::function<void(SQLite::Database&)>& fill);

/// An existing database, to read, as it stands: not necessarily of this version. Works for files and folders that can't be
/// written; a database that was left by a killed process is read with all that was committed. Throws InputError for a file
/// that is missing, damaged, no study or of a newer version.
SQLite::Database open_as_it_is(const std::filesystem::path& path);

/// As `open_as_it_is`, but always of this version: the content of an older one is brought there in memory.
SQLite::Database open_database_to_read(const std::filesystem::path& path);

/// An existing database, to write; an older version is brought to this one for good. Throws as `open_as_it_is`, and
/// FailureError for a file or folder that can't be written.
SQLite::Database open_database_to_write(const std::filesystem::path& path);

}  // namespace stairstep
