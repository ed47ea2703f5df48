// stairstep-study simulate as scripts run it: killed at any instant, it goes on to the same study.
#include <SQLiteCpp/SQLiteCpp.h>
#include <fcntl.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <map>
#include <nlohmann/json.hpp>
#include <sstream>

#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "stimuli/random.h"
#include "tests/support/command.h"
#include "tests/support/version_1_study.h"

namespace stairstep {
namespace {

namespace fs = std::filesystem;

#if defined(__SANITIZE_ADDRESS__)
constexpr int kKills = 25;
#else
constexpr int kKills = 200;  // with those of tests/study/store_faults_test.cpp more than a thousand
#endif

/// Two rounds of two tracks, with everything that a session can have.
constexpr const char* kDesign = R"({"name": "small", "patterns": ["step"], "texels_px": [5, 10],
    "stop": {"most_trials": 15}, "practice_trials": 2, "catch_share": 0.1, "break_every_trials": 20})";
constexpr const char* kFlags =
    " --observers 3 --seed 8 --redo 0.1 --drift 0.02 --fatigue 0.1 --bias 0.2 --beta 2.5 --json-lines";

class Simulate : public testing::Test {
  protected:
    Simulate() { std::ofstream(folder_.path() / "design.json") << kDesign; }

    CommandResult run(const std::string& command) {
        return run_command("cd " + folder_.path().string() + " && PATH=" + STAIRSTEP_BIN_DIR + ":$PATH && " + command);
    }
    std::string done(const std::string& command) {
        const CommandResult result = run(command);
        EXPECT_EQ(result.exit_code, 0) << command << "\n" << result.errors;
        return result.output;
    }
    /// What `command` refuses, in one line that names something, leaving the database as it is.
    void expect_refused(const std::string& command, const std::string& names, int exit_code = 2) {
        const std::string before = done("cat *.sqlite | md5sum; ls");
        const CommandResult result = run(command);
        EXPECT_EQ(result.exit_code, exit_code) << command << "\n" << result.errors;
        EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
        EXPECT_NE(result.errors.find(names), std::string::npos) << result.errors;
        EXPECT_EQ(done("cat *.sqlite | md5sum; ls"), before) << command;
    }

    TemporaryFolder folder_;
};

/// Lines by session and presentation, and whether they are of a trial taken back.
using Lines = std::map<std::tuple<int, int, bool>, std::string>;

/// Adds whole lines; the last may have been cut short.
void add_lines(Lines& lines, const std::string& text) {
    std::istringstream stream(text);
    for (std::string line; std::getline(stream, line) && !stream.eof();) {
        const auto json = nlohmann::json::parse(line);
        const bool is_new =
            lines.emplace(std::tuple(json["session"], json["presentation"], json.contains("void")), line).second;
        EXPECT_TRUE(is_new) << "twice: " << line;
    }
}

struct KilledRun {
    std::string output;
    /// Rather than done before.
    bool was_killed = false;
};

/// Runs the program and kills it some time after its n-th line.
KilledRun killed_run(const std::vector<std::string>& arguments, size_t least, int delay_us) {
    int ends[2];
    EXPECT_EQ(pipe(ends), 0);
    const pid_t child = fork();
    if (child == 0) {
        dup2(ends[1], STDOUT_FILENO);
        dup2(open("/dev/null", O_WRONLY), STDERR_FILENO);
        close(ends[0]);
        close(ends[1]);
        std::vector<char*> list;
        for (const std::string& argument : arguments) list.push_back(const_cast<char*>(argument.c_str()));
        list.push_back(nullptr);
        execv(list[0], list.data());
        _exit(127);
    }
    close(ends[1]);
    std::string output;
    const auto hear = [&] {
        char text[4096];
        const ssize_t length = read(ends[0], text, sizeof text);
        if (length > 0) output.append(text, static_cast<size_t>(length));
        return length > 0;
    };
    while (static_cast<size_t>(std::count(output.begin(), output.end(), '\n')) < least && hear()) {
    }
    usleep(static_cast<useconds_t>(delay_us));
    kill(child, SIGKILL);
    int status = 0;
    waitpid(child, &status, 0);
    EXPECT_TRUE(WIFSIGNALED(status) || WEXITSTATUS(status) == 0);
    while (hear()) {
    }
    close(ends[0]);
    return {output, WIFSIGNALED(status)};
}

TEST_F(Simulate, GoesOnAfterAnyKillToTheSameTrialsAndPosteriors) {
    Lines whole;
    add_lines(whole, done(std::string("stairstep-study simulate --db whole.sqlite --design design.json") + kFlags));
    done("stairstep-study export --db whole.sqlite --out whole");
    ASSERT_GT(whole.size(), 200u);

    const std::string database = (folder_.path() / "killed.sqlite").string();
    std::vector<std::string> arguments{program("stairstep-study"),
                                       "simulate",
                                       "--resume",
                                       "--db",
                                       database,
                                       "--design",
                                       (folder_.path() / "design.json").string()};
    std::istringstream flags(kFlags);
    for (std::string flag; flags >> flag;) arguments.push_back(flag);

    Random random(4);
    for (int kills = 0; kills < kKills;) {
        Lines lines;
        size_t missing = 0;
        for (bool was_killed = true; was_killed && kills < kKills;) {
            const KilledRun run = killed_run(arguments, random.below(8), static_cast<int>(random.below(4000)));
            add_lines(lines, run.output);
            was_killed = run.was_killed;
            kills += was_killed;
            missing += was_killed;  // stored, and killed before its line
        }
        const CommandResult rest =
            run(std::string("stairstep-study simulate --resume --db killed.sqlite --design design.json") + kFlags);
        ASSERT_EQ(rest.exit_code, 0) << rest.errors;
        add_lines(lines, rest.output);
        EXPECT_LE(lines.size(), whole.size());
        EXPECT_GE(lines.size() + missing, whole.size());
        for (const auto& [key, line] : lines) ASSERT_EQ(line, whole[key]);
        done("stairstep-study export --db killed.sqlite --out killed && cmp whole/trials.csv killed/trials.csv");
        done("stairstep-study check --db killed.sqlite");
        // Nothing stays beside the finished database.
        EXPECT_EQ(done("ls -A | grep killed"), "killed\nkilled.sqlite\n");
        fs::remove(database);
    }
}

TEST_F(Simulate, PrintsALineForEachTrialWithItsTracksEstimate) {
    const CommandResult result =
        run(std::string("stairstep-study simulate --db :memory: --design design.json") + kFlags);
    ASSERT_EQ(result.exit_code, 0);
    EXPECT_NE(result.errors.find("simulated 3 observers"), std::string::npos);
    Lines lines;
    add_lines(lines, result.output);
    int voids = 0;
    std::map<std::pair<int, int>, std::pair<double, double>> estimates;  // by session and track
    std::istringstream stream(result.output);
    int presentation = 0;
    int session = 0;
    for (std::string text; std::getline(stream, text);) {
        const auto line = nlohmann::json::parse(text);
        if (line["session"] != session) presentation = 0;
        session = line["session"];
        const std::pair key(session, line["track"].get<int>());
        const std::pair estimate(line["threshold"].get<double>(), line["sd"].get<double>());
        if (line.contains("void")) {
            ++voids;
            EXPECT_EQ(line["presentation"], presentation);
        } else {
            EXPECT_EQ(line["presentation"], ++presentation);
            EXPECT_EQ(line["correct"].get<bool>(), line["stimulus"] == line["response"]);
            EXPECT_GT(line["radius_px"], 0);
            // What is no evidence teaches nothing.
            if (line["kind"] != "main" && estimates.contains(key)) {
                EXPECT_EQ(estimates[key], estimate);
            }
        }
        estimates[key] = estimate;
    }
    EXPECT_GT(voids, 5);
    EXPECT_EQ(fs::exists(folder_.path() / ":memory:"), false);
}

TEST_F(Simulate, AddsObserversAndLeavesThoseThatAreThere) {
    const std::string design = " --design design.json";
    done("stairstep-study simulate --observers 4 --seed 2 --db four.sqlite" + design);
    done("stairstep-study simulate --observers 2 --seed 2 --db grown.sqlite" + design);
    done("stairstep-study simulate --observers 4 --resume --db grown.sqlite");
    done(
        "stairstep-study export --db four.sqlite --out four; stairstep-study export --db grown.sqlite --out grown;"
        "cmp four/trials.csv grown/trials.csv");
    EXPECT_NE(done("stairstep-study simulate --resume --db grown.sqlite").find("0 more trials"), std::string::npos);
}

TEST_F(Simulate, RefusesToGoOnWithWhatContradictsTheDatabase) {
    done("stairstep-study simulate --observers 2 --seed 2 --lapse 0.03 --db s.sqlite --design design.json");
    const std::string resume = "stairstep-study simulate --resume --db s.sqlite";
    expect_refused(resume + " --seed 3", "--seed 3: the database was begun with 2");
    expect_refused(resume + " --lapse 0.02", "--lapse 0.02: the database was begun with 0.03");
    expect_refused(resume + " --redo 0.1", "--redo 0.1");
    expect_refused(resume + " --observers 1", "--observers 1: the database was begun with 2");
    done("stairstep-study design >other.json");
    expect_refused(resume + " --design other.json", "other.json: isn't the design");
    expect_refused("stairstep-study simulate --db s.sqlite --seed 2", "s.sqlite: already exists");
    expect_refused("stairstep-study simulate --resume --db :memory:", "--resume: nothing is kept");
    // What an older version recorded is not brought to this one in passing.
    make_version_1_study(folder_.path() / "old.sqlite");
    expect_refused("stairstep-study simulate --resume --db old.sqlite", "old.sqlite: plan");
    EXPECT_NE(done("stairstep-study check --db old.sqlite").find("2 sessions of an older version can't be replayed"),
              std::string::npos);
    // The design is compared by what it says, not by how it is written.
    done("stairstep-study design design.json >whole.json");
    done(resume + " --seed 2 --lapse 0.03 --observers 2 --design whole.json");
}

TEST_F(Simulate, RefusesASecondProcessAndNamesTheFirst) {
    done("stairstep-study simulate --observers 2 --db s.sqlite --design design.json");
    // A holder that does nothing but hold: the lock of the running simulation.
    const CommandResult result =
        run("exec 9>s.sqlite.simulation.lock; flock -n 9 || exit 7; echo 'process 4711 of ann on lab since today' >&9; "
            "stairstep-study simulate --resume --observers 3 --db s.sqlite");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
    EXPECT_NE(result.errors.find("is being written by process 4711 of ann on lab since today"), std::string::npos)
        << result.errors;
    done("stairstep-study simulate --resume --observers 3 --db s.sqlite");
}

TEST_F(Simulate, TakesItsDesignFromTheFile) {
    done("stairstep-study simulate --observers 1 --db s.sqlite --design design.json");
    EXPECT_NE(done("stairstep-study status --db s.sqlite").find("study small"), std::string::npos);
    for (const char* bad :
         {"{", "[]", R"({"texels_px": []})", R"({"texel_px": [5]})", R"({"stop": {"most_trials": 0}})",
          R"({"engine": {"name": "blob"}})", R"({"catch_share": 2})"}) {
        std::ofstream(folder_.path() / "bad.json") << bad;
        expect_refused("stairstep-study simulate --db new.sqlite --design bad.json", "bad.json");
        expect_refused("stairstep-study design bad.json", "bad.json");
    }
    expect_refused("stairstep-study simulate --db new.sqlite --design absent.json", "absent.json");
    // What is printed is a design again, the same one.
    done("stairstep-study design design.json >once.json && stairstep-study design once.json | cmp - once.json");
}

TEST_F(Simulate, SaysThatTheDiskIsFullAndGoesOnOnceThereIsRoom) {
    const std::string simulate = "stairstep-study simulate --seed 5 --observers 3 --design design.json";
    done(simulate + " --db whole.sqlite && stairstep-study export --db whole.sqlite --out whole");
    // 160 blocks hold the empty database and a part of its log.
    const CommandResult full = run("(trap '' XFSZ; ulimit -f 160; " + simulate + " --db s.sqlite --json-lines)");
    EXPECT_EQ(full.exit_code, 1);
    EXPECT_TRUE(is_one_error_line(full.errors)) << full.errors;
    EXPECT_NE(full.errors.find("s.sqlite"), std::string::npos) << full.errors;
    EXPECT_NE(full.errors.find("free space"), std::string::npos) << full.errors;
    const auto acknowledged = std::count(full.output.begin(), full.output.end(), '\n');
    EXPECT_GT(acknowledged, 3);
    EXPECT_NE(done("stairstep-study status --db s.sqlite --json").find("\"trials\": " + std::to_string(acknowledged)),
              std::string::npos);
    done("stairstep-study check --db s.sqlite");
    done(simulate +
         " --db s.sqlite --resume && stairstep-study export --db s.sqlite --out s && "
         "cmp s/trials.csv whole/trials.csv");
}

TEST_F(Simulate, MeetsAFullFileSystem) {
    // A file system of its own, 300 KiB: needs the right to mount in a name space of one's own.
    const std::string inside = "mkdir tiny && mount -t tmpfs -o size=300k none tiny && cd tiny && ";
    if (run("unshare -rm sh -c '" + inside + "true'").exit_code != 0) GTEST_SKIP() << "can't mount here";
    done("rmdir tiny");
    const CommandResult result =
        run("unshare -rm sh -c '" + inside +
            "stairstep-study simulate --observers 20 --db s.sqlite --json-lines >../lines; echo $? >../code; "
            "stairstep-study status --db s.sqlite --json >../status'");
    EXPECT_EQ(read_file(folder_.path() / "code"), "1\n");
    EXPECT_NE(result.errors.find("s.sqlite: the database can't be used (database or disk is full"), std::string::npos)
        << result.errors;
    const std::string lines = read_file(folder_.path() / "lines");
    const auto acknowledged = std::count(lines.begin(), lines.end(), '\n');
    EXPECT_GT(acknowledged, 3);
    EXPECT_NE(read_file(folder_.path() / "status").find("\"trials\": " + std::to_string(acknowledged)),
              std::string::npos);
}

TEST_F(Simulate, ChecksADatabaseAndSaysWhatIsWrong) {
    done("stairstep-study simulate --observers 2 --db s.sqlite --design design.json");
    const std::string well = done("stairstep-study check --db s.sqlite");
    EXPECT_EQ(std::count(well.begin(), well.end(), '\n'), 1);
    EXPECT_NE(well.find("s.sqlite is well: 2 sessions"), std::string::npos);
    EXPECT_EQ(nlohmann::json::parse(done("stairstep-study check --json --db s.sqlite"))["problems"].size(), 0u);
    SQLite::Database((folder_.path() / "s.sqlite").string(), SQLite::OPEN_READWRITE)
        .exec(
            "DROP TRIGGER trial_is_final_update;"
            "UPDATE trial SET response_time_s = 0 WHERE session = 2 AND presentation = 3");
    const CommandResult result = run("stairstep-study check --db s.sqlite");
    EXPECT_EQ(result.exit_code, 1);
    EXPECT_EQ(result.output,
              "schema: trigger trial_is_final_update is missing\n"
              "session 2, presentation 3: has the response time 0 s\n");
    EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
    EXPECT_EQ(nlohmann::json::parse(run("stairstep-study check --json --db s.sqlite").output)["problems"].size(), 2u);
    for (const char* bad : {"absent.sqlite", "design.json", "."}) {
        expect_refused(std::string("stairstep-study check --db ") + bad, bad);
    }
}

}  // namespace
}  // namespace stairstep
