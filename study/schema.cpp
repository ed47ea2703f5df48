#include "study/schema.h"

#include <map>

#include "embedded/study.h"

namespace stairstep {
namespace {

int pragma(const SQLite::Database& database, const char* name) {
    SQLite::Statement query(database, std::string("PRAGMA ") + name);
    query.executeStep();
    return query.getColumn(0).getInt();
}

/// "trigger trial_is_final_update" → its SQL, for all that a schema has by name; SQLite's own tables left out.
std::map<std::string, std::string> schema_objects(const SQLite::Database& database) {
    std::map<std::string, std::string> objects;
    SQLite::Statement query(database,
                            "SELECT type || ' ' || name, coalesce(sql, '') FROM sqlite_schema "
                            "WHERE name NOT LIKE 'sqlite_%'");
    while (query.executeStep()) objects[query.getColumn(0).getString()] = query.getColumn(1).getString();
    return objects;
}

}  // namespace

int application_id(const SQLite::Database& database) {
    return pragma(database, "application_id");
}

int schema_version(const SQLite::Database& database) {
    return pragma(database, "user_version");
}

void create_schema(SQLite::Database& database) {
    database.exec("PRAGMA application_id = " + std::to_string(kApplicationId));
    database.exec("PRAGMA user_version = " + std::to_string(kSchemaVersion));
    database.exec(std::string(embedded::schema_sql));
}

void migrate_schema(SQLite::Database& database) {
    SQLite::Transaction transaction(database, SQLite::TransactionBehavior::IMMEDIATE);
    if (schema_version(database) == kSchemaVersion) return;
    database.exec(std::string(embedded::schema_1_before_sql));
    create_schema(database);
    database.exec(std::string(embedded::schema_1_after_sql));
    transaction.commit();
}

std::vector<std::string> schema_faults(const SQLite::Database& database) {
    const std::map<std::string, std::string> found = schema_objects(database);
    std::vector<std::string> faults;
    if (schema_version(database) == 1) {
        for (const char* trigger :
             {"trial_is_final_update", "trial_is_final_delete", "session_is_final_update", "session_is_final_delete"}) {
            const std::string object = std::string("trigger ") + trigger;
            if (!found.contains(object)) faults.push_back(object + " is missing");
        }
        return faults;
    }
    SQLite::Database fresh(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
    create_schema(fresh);
    const std::map<std::string, std::string> expected = schema_objects(fresh);
    for (const auto& [object, sql] : expected) {
        const auto it = found.find(object);
        if (it == found.end()) {
            faults.push_back(object + " is missing");
        } else if (it->second != sql) {
            faults.push_back(object + " isn't what this version has");
        }
    }
    for (const auto& [object, sql] : found) {
        if (!expected.contains(object)) faults.push_back(object + " doesn't belong here");
    }
    return faults;
}

}  // namespace stairstep
