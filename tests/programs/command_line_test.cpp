// Every program meets bad input: one error line that names what was read, the right exit code, and nothing left behind.
#include <gtest/gtest.h>

#include <filesystem>

#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/session.h"
#include "study/simulated_observer.h"
#include "study/store.h"
#include "study/trials_csv.h"
#include "tests/support/command.h"

namespace stairstep {
namespace {

struct BadCommand {
    /// Run in a folder that holds good.csv, good.sqlite, cut.sqlite, text.txt, cut.json, blank.csv, falling.csv (a
    /// transfer), bad-grid.csv.
    const char* command;
    int exit_code;
    /// What the error line must name.
    const char* names;
};

/// CTest calls a case by its command.
void PrintTo(const BadCommand& bad, std::ostream* stream) {
    *stream << bad.command;
}

class BadInput : public testing::TestWithParam<BadCommand> {};

/// What lies in a folder, with the size of each file.
std::string listing(const std::filesystem::path& folder) {
    std::vector<std::string> entries;
    for (const auto& entry : std::filesystem::recursive_directory_iterator(folder)) {
        const std::string name = entry.path().filename().string();
        entries.push_back(name + (entry.is_regular_file() ? " " + std::to_string(entry.file_size()) : ""));
    }
    std::sort(entries.begin(), entries.end());
    std::string text;
    for (const std::string& entry : entries) text += entry + "\n";
    return text;
}

/// good.sqlite and good.csv: two observers, one condition, two sizes; the least that a law can be fitted to.
void make_small_study(const std::filesystem::path& folder) {
    Design design;
    design.patterns = {Pattern::step};
    design.contrasts = {1};
    design.texels_px = {5, 10};
    design.stop.most_trials = 30;
    TrialStore store = TrialStore::create(folder / "good.sqlite", design.name, "{}");
    for (int i = 0; i < 2; ++i) {
        SimulatedObserver observer({}, Random(static_cast<uint64_t>(i)), 0);
        const std::string name = "o" + std::to_string(i);
        const int session = store.begin_session({1, name, i, 1, "simulated", "{}", std::nullopt});
        Session run(design, {name, i, session, 1});
        run_session(run, observer, {[&](const Trial& trial) { store.append(trial); }});
        store.end_session(session, SessionEnd::finished);
    }
    write_file(folder / "good.csv", trials_csv(store.trials()));
}

TEST_P(BadInput, GetsOneErrorLineAndLeavesNothing) {
    const TemporaryFolder folder;
    const std::string in = "cd " + folder.path().string() + " && PATH=" + STAIRSTEP_BIN_DIR + ":$PATH && ";
    make_small_study(folder.path());
    ASSERT_EQ(
        run_command(in + "head -c 12000 good.sqlite >cut.sqlite; head -c 1000 good.csv >cut.csv; "
                         "cut -d, -f1-12 good.csv >no-response.csv; "
                         "echo hello >text.txt; echo '{\"format\":' >cut.json; : >blank.csv; "
                         "printf 'level,luminance\\n0,2\\n1,1\\n' >falling.csv; "
                         "printf 'pattern,kernel,contrast,texel_px,radius_px\\nstep,box,1,5,5\\nstep,box,2,5,5\\n' "
                         ">bad-grid.csv")
            .exit_code,
        0);

    const std::string before = listing(folder.path());
    const CommandResult result = run_command(in + GetParam().command);
    EXPECT_EQ(result.exit_code, GetParam().exit_code) << result.errors;
    EXPECT_TRUE(is_one_error_line(result.errors)) << result.errors;
    EXPECT_NE(result.errors.find(GetParam().names), std::string::npos) << result.errors;
    EXPECT_EQ(listing(folder.path()), before);
}

INSTANTIATE_TEST_SUITE_P(
    Stimuli, BadInput,
    testing::Values(BadCommand{"stairstep-stimuli", 2, "--out"},
                    BadCommand{"stairstep-stimuli --out x --blob", 2, "--blob"},
                    BadCommand{"stairstep-stimuli --out x --texel 0", 2, "texel size 0"},
                    BadCommand{"stairstep-stimuli --out x --texel -5", 2, "texel size -5"},
                    BadCommand{"stairstep-stimuli --out x --texel nan", 2, "--texel"},
                    BadCommand{"stairstep-stimuli --out x --radius -1", 2, "filter radius -1"},
                    BadCommand{"stairstep-stimuli --out x --radius 0:1e-9:80", 2, "--radius"},
                    BadCommand{"stairstep-stimuli --out x --contrast 1.5", 2, "contrast 1.5"},
                    BadCommand{"stairstep-stimuli --out x --contrast 0", 2, "contrast 0"},
                    BadCommand{"stairstep-stimuli --out x --size 0x480", 2, "--size"},
                    BadCommand{"stairstep-stimuli --out x --size 1000000000x480", 2, "--size"},
                    BadCommand{"stairstep-stimuli --out x --pattern blob", 2, "blob"},
                    BadCommand{"stairstep-stimuli --out x --kernel blob", 2, "blob"},
                    BadCommand{"stairstep-stimuli --out x --pattern slope=-1", 2, "slope -1"},
                    BadCommand{"stairstep-stimuli --out x --pattern slope=", 2, "slope="},
                    BadCommand{"stairstep-stimuli --out x --phase 0.5", 2, "--phase"},
                    BadCommand{"stairstep-stimuli --out x --kernel poisson --taps 0", 2, "taps 0"},
                    BadCommand{"stairstep-stimuli reference --pattern line", 2, "line"},
                    BadCommand{"stairstep-stimuli reference --largest 0", 2, "--largest"},
                    BadCommand{"stairstep-stimuli reference --law absent.json", 2, "absent.json"},
                    BadCommand{"stairstep-stimuli --out x --bits 12", 2, "--bits"},
                    BadCommand{"stairstep-stimuli --out x --bits 32", 2, "--bits"},
                    BadCommand{"stairstep-stimuli --out x --format exr --bits 16", 2, "--bits"},
                    BadCommand{"stairstep-stimuli --out x --format jpg", 2, "--format"},
                    BadCommand{"stairstep-stimuli --out x --format exr --dither ordered", 2, "--dither"},
                    BadCommand{"stairstep-stimuli --out x --radius 1e39", 2, "filter radius 1e+39"},
                    BadCommand{"stairstep-stimuli --out x --contrast nan", 2, "--contrast"},
                    BadCommand{"stairstep-stimuli --out x --size 100000x10000", 2, "--size"},
                    BadCommand{"stairstep-stimuli --out x --transfer absent.csv", 2, "absent.csv"},
                    BadCommand{"stairstep-stimuli --out x --transfer gamma=0", 2, "gamma=0"},
                    BadCommand{"stairstep-stimuli --out x --transfer falling.csv", 2, "falling.csv: line 3"},
                    BadCommand{"stairstep-stimuli --out x --transfer text.txt", 2, "text.txt"},
                    BadCommand{"stairstep-stimuli --out x --pixels-per-degree -60", 2, "--pixels-per-degree"},
                    BadCommand{"stairstep-stimuli --out x --pixels-per-degree nan", 2, "--pixels-per-degree"},
                    BadCommand{"stairstep-stimuli --out x --shard 5/4", 2, "--shard"},
                    BadCommand{"stairstep-stimuli --out x --contact-sheet x.png --contours 0", 2, "--contours"},
                    BadCommand{"stairstep-stimuli --out x --contact-sheet x.png --contours -3", 2, "--contours"},
                    BadCommand{"stairstep-stimuli --out x --contact-sheet x.png --contours 100", 2, "--contours"},
                    BadCommand{"stairstep-stimuli --out x --contact-sheet x.png --contours 2.5", 2, "--contours"},
                    BadCommand{"stairstep-stimuli --out x --contact-sheet x.png --contours many", 2, "--contours"},
                    BadCommand{"stairstep-stimuli --out x --contact-sheet x.png --contours nan", 2, "--contours"},
                    BadCommand{"stairstep-stimuli --out x --contours 3", 2, "--contact-sheet"},
                    BadCommand{"stairstep-stimuli --out x --grid absent.csv", 2, "absent.csv"},
                    BadCommand{"stairstep-stimuli --out x --grid good.csv", 2, "good.csv"},
                    BadCommand{"stairstep-stimuli --out x --grid blank.csv", 2, "blank.csv"},
                    BadCommand{"stairstep-stimuli --out x --grid bad-grid.csv", 2, "bad-grid.csv: line 3"},
                    BadCommand{"stairstep-stimuli --out x --grid g.csv --texel 5", 2, "--grid"},
                    BadCommand{"stairstep-stimuli verify", 2, "folder"},
                    BadCommand{"stairstep-stimuli verify absent", 2, "absent/stimuli.csv"},
                    BadCommand{"stairstep-stimuli --texel 5 verify absent", 2, "--texel"},
                    BadCommand{"stairstep-stimuli --out text.txt", 1, "text.txt"},
                    BadCommand{"stairstep-stimuli --out /proc/self/x", 1, "/proc/self/x"}));

INSTANTIATE_TEST_SUITE_P(
    Study, BadInput,
    testing::Values(BadCommand{"stairstep-study", 2, "subcommand"}, BadCommand{"stairstep-study simulate", 2, "--db"},
                    BadCommand{"stairstep-study simulate --db good.sqlite", 2, "good.sqlite"},
                    BadCommand{"stairstep-study simulate --db absent/x.sqlite", 1, "absent/x.sqlite"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --observers 0", 2, "--observers"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --law-slope 0", 2, "law slope 0"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --law-slope nan", 2, "law slope nan"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --lapse 0.9", 2, "lapse rate 0.9"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --beta 0", 2, "steepness 0"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --bias 0.6", 2, "response bias 0.6"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --drift nan", 2, "drift nan"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --fatigue -1", 2, "fatigue -1"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --redo 0.6", 2, "redo share 0.6"},
                    BadCommand{"stairstep-study simulate --db x.sqlite --design text.txt", 2, "text.txt"},
                    BadCommand{"stairstep-study simulate --db .", 2, "."},
                    BadCommand{"stairstep-study simulate --resume --db good.sqlite", 2, "good.sqlite: plan"},
                    BadCommand{"stairstep-study simulate --resume --db text.txt", 2, "text.txt"},
                    BadCommand{"stairstep-study simulate --resume --db cut.sqlite", 2, "cut.sqlite"},
                    BadCommand{"stairstep-study simulate --resume --db blank.csv", 2, "blank.csv"},
                    BadCommand{"stairstep-study simulate --resume --db .", 2, "is a folder"},
                    BadCommand{"stairstep-study check", 2, "--db"},
                    BadCommand{"stairstep-study check --db absent.sqlite", 2, "absent.sqlite"},
                    BadCommand{"stairstep-study check --db text.txt", 2, "text.txt"},
                    BadCommand{"stairstep-study check --db blank.csv", 2, "blank.csv"},
                    BadCommand{"stairstep-study design cut.json", 2, "cut.json"},
                    BadCommand{"stairstep-study export --db absent.sqlite --out y", 2, "absent.sqlite"},
                    BadCommand{"stairstep-study export --db text.txt --out y", 2, "text.txt"},
                    BadCommand{"stairstep-study export --db cut.sqlite --out y", 2, "cut.sqlite"},
                    BadCommand{"stairstep-study export --db good.sqlite --out text.txt", 1, "text.txt"},
                    BadCommand{"stairstep-study status --db blank.csv", 2, "blank.csv"}));

INSTANTIATE_TEST_SUITE_P(
    Analyze, BadInput,
    testing::Values(BadCommand{"stairstep-analyze fit absent.csv --out law.json", 2, "absent.csv"},
                    BadCommand{"stairstep-analyze fit absent.sqlite --out law.json", 2, "absent.sqlite"},
                    BadCommand{"stairstep-analyze fit cut.csv --out law.json", 2, "cut.csv: line"},
                    BadCommand{"stairstep-analyze fit cut.sqlite --out law.json", 2, "cut.sqlite"},
                    BadCommand{"stairstep-analyze fit blank.csv --out law.json", 2, "blank.csv"},
                    BadCommand{"stairstep-analyze fit no-response.csv --out law.json", 2, "no column \"stimulus\""},
                    BadCommand{"stairstep-analyze fit good.csv --out absent/law.json", 1, "absent/law.json"},
                    BadCommand{"stairstep-analyze fit good.csv --out law.json --p 1", 2, "--p"},
                    BadCommand{"stairstep-analyze fit good.csv --out law.json --p 0.75,0.9 --out-p 0.8", 2, "--out-p"},
                    BadCommand{"stairstep-analyze fit good.csv --out law.json --simulations -1", 2, "--simulations"},
                    BadCommand{"stairstep-analyze report good.csv --out r --simulations many", 2, "--simulations"},
                    BadCommand{"stairstep-analyze fit good.csv", 2, "--out"},
                    BadCommand{"stairstep-analyze report good.csv --out r --contact-sheet absent.png", 2, "absent.png"},
                    BadCommand{"stairstep-analyze report good.csv --out r --contact-sheet text.txt", 2, "text.txt"},
                    BadCommand{"stairstep-analyze report good.csv --out r --renderings cut.json", 2, "cut.json"},
                    BadCommand{"stairstep-analyze report good.csv --out text.txt", 1, "text.txt"}));

TEST(CommandLine, EveryProgramHelps) {
    for (const char* name : {"stairstep-stimuli", "stairstep-study", "stairstep-analyze", "stairstep-render"}) {
        const CommandResult help = run_command(program(name) + " --help");
        EXPECT_EQ(help.exit_code, 0);
        EXPECT_NE(help.output.find(name), std::string::npos);
        EXPECT_EQ(help.errors, "");
        EXPECT_EQ(run_command(program(name) + " --version").exit_code, 0);
    }
}

TEST(CommandLine, AFullDiskIsSaidAndLeavesNoPartialFile) {
    const TemporaryFolder folder;
    ASSERT_EQ(
        run_command(program("stairstep-study") + " simulate --observers 2 --db " + folder.path().string() + "/s.sqlite")
            .exit_code,
        0);
    // A limit on file size stands in for a full disk.
    const CommandResult result =
        run_command("trap '' XFSZ; ulimit -f 4; " + program("stairstep-study") + " export --db " +
                    folder.path().string() + "/s.sqlite --out " + folder.path().string());
    EXPECT_EQ(result.exit_code, 1) << result.errors;
    EXPECT_FALSE(std::filesystem::exists(folder.path() / "trials.csv"));
    for (const auto& entry : std::filesystem::directory_iterator(folder.path())) {
        EXPECT_EQ(entry.path().string().find("partial"), std::string::npos) << entry.path();
    }
}

}  // namespace
}  // namespace stairstep
