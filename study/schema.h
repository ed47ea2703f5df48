// What a study's database holds, by version: tables, triggers, and the way from an older version to this one.
//
// Version 1: one unnamed task, trials numbered in their track alone. Version 2: presentations, kinds of trials, trials taken
// back, how sessions ended, and the plan. All throw SQLite::Exception where the database refuses.
#pragma once

#include <SQLiteCpp/SQLiteCpp.h>

#include <string>
#include <vector>

namespace stairstep {

constexpr int kSchemaVersion = 2;

/// "StSp", in SQLite's header: tells a Stairstep study from any other database.
constexpr int kApplicationId = 0x53745370;

/// Whole numbers of SQLite's header.
int application_id(const SQLite::Database& database);
int schema_version(const SQLite::Database& database);

/// Makes an empty database one of this version. To be called inside a transaction.
void create_schema(SQLite::Database& database);

/// Brings a database of version 1 to this one, in a transaction of its own: wholly, or not at all. Does nothing to one that
/// is there already, also if another process brought it there in the meantime.
void migrate_schema(SQLite::Database& database);

/// Tables, indices and triggers that aren't as the database's version has them, one sentence each: "trigger X is missing".
/// For version 1 only the triggers are compared.
std::vector<std::string> schema_faults(const SQLite::Database& database);

}  // namespace stairstep
