#include "study/trials_csv.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

class TrialsCsv : public testing::Test {
  protected:
    std::vector<Trial> read(const std::string& text) {
        write_file(folder_.path() / "trials.csv", text);
        return read_trials_csv(folder_.path() / "trials.csv");
    }
    std::string error_of(const std::string& text) {
        try {
            read(text);
        } catch (const InputError& e) {
            return std::string(e.what()).substr(folder_.path().string().size() + 1);
        }
        return "none";
    }

    TemporaryFolder folder_;
};

TEST_F(TrialsCsv, HasTheContractsColumnsAndReadsBack) {
    Trial trial;
    trial.study = "a, \"b\"";
    trial.observer = "o1";
    trial.condition = {Pattern::stair, KernelShape::disk, 0.5, 7.5};
    trial.suggested_radius_px = 20.123456789012345;
    trial.radius_px = 20;
    trial.shown_at_s = 1700000000.1234;
    trial.presentation = 9;
    trial.task = Task::two_alternative;
    trial.is_void = true;
    const std::string text = trials_csv({trial});
    EXPECT_TRUE(
        text.starts_with("study,observer,session,round,track,trial,pattern,kernel,contrast,texel_px,"
                         "suggested_radius_px,radius_px,stimulus,response,correct,response_time_s,shown_at,"
                         "dropped_frames,presentation,kind,task,void\n"));
    EXPECT_NE(text.find("2023-11-14T22:13:20.123Z"), std::string::npos) << text;
    const std::vector<Trial> back = read(text);
    ASSERT_EQ(back.size(), 1u);
    EXPECT_EQ(back[0].study, trial.study);
    EXPECT_EQ(back[0].condition, trial.condition);
    EXPECT_EQ(back[0].suggested_radius_px, trial.suggested_radius_px);
    EXPECT_EQ(back[0].radius_px, trial.radius_px);
    EXPECT_EQ(back[0].presentation, 9);
    EXPECT_EQ(back[0].task, Task::two_alternative);
    EXPECT_TRUE(back[0].is_void);
    EXPECT_TRUE(evidence(back).empty());
}

TEST_F(TrialsCsv, NeedsEightColumnsAlone) {
    const std::vector<Trial> trials = read(
        "response,stimulus,radius_px,texel_px,contrast,kernel,pattern,observer,mood\n"
        "line,artifact,12,5,1,box,step,o1,bored\n");
    ASSERT_EQ(trials.size(), 1u);
    EXPECT_FALSE(trials[0].correct());
    EXPECT_EQ(trials[0].suggested_radius_px, 12);
}

TEST_F(TrialsCsv, ErrorsNameLineAndColumn) {
    const std::string header = "observer,pattern,kernel,contrast,texel_px,radius_px,stimulus,response\n";
    EXPECT_TRUE(error_of("observer,pattern\no,step\n").starts_with("trials.csv: has no column \"kernel\""));
    EXPECT_TRUE(error_of(header).starts_with("trials.csv: holds no trial"));
    const std::string good = "o,step,box,1,5,12,line,line\n";
    const std::pair<const char*, const char*> cases[] = {
        {"o,blob,box,1,5,12,line,line\n", "line 3, column pattern"},
        {"o,line,box,1,5,12,line,line\n", "line 3, column pattern"},
        {"o,step,blob,1,5,12,line,line\n", "line 3, column kernel"},
        {"o,step,box,2,5,12,line,line\n", "line 3, column contrast"},
        {"o,step,box,1,0,12,line,line\n", "line 3, column texel_px"},
        {"o,step,box,1,5,-1,line,line\n", "line 3, column radius_px"},
        {"o,step,box,1,5,nan,line,line\n", "line 3, column radius_px"},
        {"o,step,box,1,5,12,circle,line\n", "line 3, column stimulus"},
        {"o,step,box,1,5,12,line,yes\n", "line 3, column response"},
        {",step,box,1,5,12,line,line\n", "line 3, column observer"},
        {"M\xfcller,step,box,1,5,12,line,line\n", "line 3, column observer: is not UTF-8"},
        // Their ratio would be no number.
        {"o,step,box,1,1e300,12,line,line\n", "line 3, column texel_px"},
        {"o,step,box,1,5,1e-300,line,line\n", "line 3, column radius_px"},
        {"o,step,box,1,5,12,line\n", "line 3 has 7 fields"},
    };
    for (const auto& [row, where] : cases) {
        EXPECT_NE(error_of(header + good + row).find(where), std::string::npos) << row << error_of(header + good + row);
    }
}

}  // namespace
}  // namespace stairstep
