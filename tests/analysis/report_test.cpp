#include "analysis/report.h"

#include <gtest/gtest.h>

#include <fstream>

#include "stimuli/error.h"
#include "stimuli/io/image_file.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"
#include "study/session.h"
#include "study/simulated_observer.h"

namespace stairstep {
namespace {

class Report : public testing::Test {
  protected:
    static void SetUpTestSuite() {
        for (int i = 0; i < 3; ++i) {
            SimulatedObserver observer({}, Random(static_cast<uint64_t>(i)), 0);
            Session session({}, {"<o" + std::to_string(i) + ">", i, i + 1, 7});
            run_session(session, observer, {[](const Trial& trial) { trials_.push_back(trial); }});
        }
        fit_ = fit_law(trials_, 0.82, "a & b");
    }

    inline static std::vector<Trial> trials_;
    inline static LawFit fit_;
    TemporaryFolder folder_;
};

TEST_F(Report, IsWholeAndNeedsNoNetwork) {
    write_png(folder_.path() / "sheet.png", Image(8, 8, 1));
    const std::string html = make_report(trials_, fit_, {(folder_.path() / "sheet.png").string(), ""}).html;
    EXPECT_EQ(html.find("{{"), std::string::npos);
    EXPECT_NE(html.find("data:image/png;base64,iVBORw0KGgo"), std::string::npos);
    EXPECT_NE(html.find("<svg"), std::string::npos);
    EXPECT_NE(html.find("&lt;o0&gt;"), std::string::npos);
    EXPECT_EQ(html.find("<o0>"), std::string::npos);
    for (const char* reference : {"src=\"http", "href=\"http", "@import", "url(http"}) {
        EXPECT_EQ(html.find(reference), std::string::npos) << reference;
    }
}

TEST_F(Report, RefusesInputsThatAreNotWhatTheyShouldBe) {
    const auto file = [this](const char* name, const std::string& text) {
        write_file(folder_.path() / name, text);
        return (folder_.path() / name).string();
    };
    EXPECT_THROW(make_report(trials_, fit_, {file("sheet.png", "no picture"), ""}), InputError);
    EXPECT_THROW(make_report(trials_, fit_, {"absent.png", ""}), InputError);
    EXPECT_THROW(make_report(trials_, fit_, {"", "absent.json"}), InputError);
    for (const char* stats : {"{", "{}", R"({"renderings":[]})", R"({"renderings":[1]})", R"({"renderings":[{}]})",
                              R"({"renderings":[{"resolution":"auto","file":"absent.png"}]})"}) {
        EXPECT_THROW(make_report(trials_, fit_, {"", file("stats.json", stats)}), InputError) << stats;
    }
}

}  // namespace
}  // namespace stairstep
