#include "study/database_file.h"

#include <SQLiteCpp/Backup.h>
#include <fcntl.h>
#include <sqlite3.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/schema.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

/// How long to wait for another process that is writing: its commits take milliseconds, a slow disk's longer.
constexpr int kBusyTimeout_ms = 20000;

fs::path folder_of(const fs::path& path) {
    return path.has_parent_path() ? path.parent_path() : fs::path(".");
}

bool can_be_written(const fs::path& path) {
    return access(path.c_str(), W_OK) == 0 && access(folder_of(path).c_str(), W_OK) == 0;
}

fs::path beside(const fs::path& path, const char* suffix) {
    fs::path file = path;
    file += suffix;
    return file;
}

bool has_content(const fs::path& path) {
    std::error_code error;
    const auto size = fs::file_size(path, error);
    return !error && size > 0;
}

void require_file(const fs::path& path) {
    std::error_code error;
    const fs::file_status status = fs::status(path, error);
    if (status.type() == fs::file_type::not_found) throw InputError(path.string(), "doesn't exist", "check the path");
    if (fs::is_directory(status)) throw InputError(path.string(), "is a folder", "name a database");
    if (!fs::is_regular_file(status)) throw InputError(path.string(), "is no regular file", "name a database");
    if (access(path.c_str(), R_OK) != 0) {
        throw FailureError(path.string(), "can't be read", "check the file's permissions");
    }
}

void require_study(const SQLite::Database& database, const fs::path& path) {
    const int version = schema_version(database);  // reads the header: throws for what is no database
    if (application_id(database) != kApplicationId) {
        throw InputError(path.string(), "is no Stairstep study", "name a database that stairstep-study wrote");
    }
    if (version < 1 || version > kSchemaVersion) {
        throw InputError(
            path.string(), "has schema version " + std::to_string(version),
            "use a Stairstep that reads it; this one reads versions 1 to " + std::to_string(kSchemaVersion));
    }
}

/// A file name as SQLite's URIs want it.
std::string uri_of(const fs::path& path, const char* query) {
    std::string uri = "file:";
    for (const char c : path.string()) {
        if (c == '%' || c == '?' || c == '#') {
            char escaped[4];
            std::snprintf(escaped, sizeof escaped, "%%%02X", static_cast<unsigned>(static_cast<unsigned char>(c)));
            uri += escaped;
        } else {
            uri += c;
        }
    }
    return uri + query;
}

SQLite::Database empty_in_memory() {
    return SQLite::Database(":memory:", SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
}

SQLite::Database copy_in_memory(SQLite::Database& source) {
    SQLite::Database copy = empty_in_memory();
    if (const int result = SQLite::Backup(copy, source).executeStep(); result != SQLITE_DONE) {
        throw SQLite::Exception(sqlite3_errstr(result), result);
    }
    return copy;
}

/// Reads a database that we may not change. Whoever opens a WAL database wants to write beside it, if only an index of the
/// WAL, so that SQLite has to be helped.
SQLite::Database open_unwritable(const fs::path& path) {
    const fs::path wal = beside(path, "-wal");
    if (!has_content(wal)) {
        // All there is stands in the file itself. `immutable` needs nothing beside it, but would not notice a writer: a copy
        // is taken at once.
        SQLite::Database database(uri_of(path, "?immutable=1"), SQLite::OPEN_READONLY | SQLite::OPEN_URI);
        return copy_in_memory(database);
    }
    if (fs::exists(beside(path, "-shm"))) {
        // Someone may be writing; the index that is there makes reading safe.
        return SQLite::Database(path.string(), SQLite::OPEN_READONLY, kBusyTimeout_ms);
    }
    // A killed process left its last commits in the WAL, or someone copied both files: nobody has them open, so that copies
    // of them agree, and where the copies lie an index can be made.
    const TemporaryFolder folder;
    const fs::path copy = folder.path() / "study.sqlite";
    fs::copy_file(path, copy);
    fs::copy_file(wal, beside(copy, "-wal"));
    fs::permissions(copy, fs::perms::owner_write, fs::perm_options::add);
    fs::permissions(beside(copy, "-wal"), fs::perms::owner_write, fs::perm_options::add);
    SQLite::Database database(copy.string(), SQLite::OPEN_READWRITE);
    return copy_in_memory(database);
}

void make_durable(SQLite::Database& database, const fs::path& path) {
    SQLite::Statement mode(database, "PRAGMA journal_mode = WAL");
    mode.executeStep();
    if (mode.getColumn(0).getString() != "wal" && !is_in_memory(path)) {
        throw FailureError(path.string(), "its file system can't hold a write-ahead log", "put it on a local disk");
    }
    database.exec("PRAGMA synchronous = FULL");
    database.exec("PRAGMA foreign_keys = ON");
}

void require_nothing_there(const fs::path& path) {
    if (fs::exists(fs::symlink_status(path))) {
        throw InputError(path.string(), "already exists, and a study is never overwritten",
                         "name another --db or move it away");
    }
}

/// Gives a finished file its name, unless something has that name by now.
void publish(OutputFile& file, const fs::path& path) {
    if (link(file.path().c_str(), path.c_str()) == 0) {
        const int folder = open(folder_of(path).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
        if (folder >= 0) {
            fsync(folder);
            close(folder);
        }
        return;
    }
    require_nothing_there(path);
    file.commit();  // a file system without hard links
}

/// Removes what processes left behind that were killed while they made a database of this name.
void remove_partial_files(const fs::path& path) {
    std::error_code error;
    for (const auto& entry : fs::directory_iterator(folder_of(path), error)) {
        const fs::path& file = entry.path();
        if (partial_file_stem(file.filename().string()) == path.stem().string() &&
            file.extension() == path.extension()) {
            fs::remove(file, error);
        }
    }
}

}  // namespace

bool is_in_memory(const fs::path& path) {
    return path == ":memory:";
}

void rethrow(const fs::path& path, const SQLite::Exception& e) {
    const std::string problem = e.what();
    switch (e.getErrorCode() & 0xff) {
        case SQLITE_NOTADB:
        case SQLITE_CORRUPT:
            throw InputError(path.string(), "is damaged or no database (" + problem + ")", "restore it from a copy");
        case SQLITE_CONSTRAINT:
        case SQLITE_MISMATCH:
            throw InputError(path.string(), "refuses this (" + problem + ")", "check the trial's values");
        case SQLITE_ERROR:
            throw InputError(path.string(), "isn't built as a study is (" + problem + ")", "restore it from a copy");
        case SQLITE_BUSY:
            throw FailureError(path.string(), "another process keeps it busy (" + problem + ")",
                               "wait for it or stop it");
        default:
            throw FailureError(path.string(), "the database can't be used (" + problem + ")",
                               "check the disk's free space and the file's permissions");
    }
}

SQLite::Database make_database(const fs::path& path, const std::function<void(SQLite::Database&)>& fill) try {
    const auto build = [&fill](SQLite::Database& database) {
        SQLite::Transaction transaction(database);
        create_schema(database);
        fill(database);
        transaction.commit();
    };
    if (is_in_memory(path)) {
        SQLite::Database database = empty_in_memory();
        make_durable(database, path);
        build(database);
        return database;
    }
    require_nothing_there(path);
    OutputFile file(path);
    fs::remove(file.path());  // of a killed process that had our number
    {
        SQLite::Database database(file.path().string(), SQLite::OPEN_READWRITE | SQLite::OPEN_CREATE);
        database.exec("PRAGMA journal_mode = MEMORY");  // half of it is of use to nobody
        database.exec("PRAGMA synchronous = FULL");
        build(database);
    }
    publish(file, path);
    return open_database_to_write(path);
} catch (const SQLite::Exception& e) {
    rethrow(path, e);
}

SQLite::Database open_as_it_is(const fs::path& path) try {
    require_file(path);
    // A reader who may write tidies the write-ahead log up when it closes.
    SQLite::Database database = can_be_written(path)
                                    ? SQLite::Database(path.string(), SQLite::OPEN_READWRITE, kBusyTimeout_ms)
                                    : open_unwritable(path);
    database.exec("PRAGMA query_only = ON");
    require_study(database, path);
    return database;
} catch (const SQLite::Exception& e) {
    rethrow(path, e);
} catch (const fs::filesystem_error& e) {
    throw FailureError(path.string(), e.code().message(), "check the file's permissions");
}

SQLite::Database open_database_to_read(const fs::path& path) try {
    SQLite::Database database = open_as_it_is(path);
    if (schema_version(database) == kSchemaVersion) return database;
    SQLite::Database copy = copy_in_memory(database);
    migrate_schema(copy);
    copy.exec("PRAGMA query_only = ON");
    return copy;
} catch (const SQLite::Exception& e) {
    rethrow(path, e);
}

SQLite::Database open_database_to_write(const fs::path& path) try {
    require_file(path);
    if (!can_be_written(path)) {
        throw FailureError(path.string(), "the database or its folder can't be written", "check their permissions");
    }
    SQLite::Database database(path.string(), SQLite::OPEN_READWRITE, kBusyTimeout_ms);
    require_study(database, path);
    make_durable(database, path);
    if (schema_version(database) != kSchemaVersion) migrate_schema(database);
    remove_partial_files(path);  // whoever is making one now comes too late
    return database;
} catch (const SQLite::Exception& e) {
    rethrow(path, e);
}

}  // namespace stairstep
