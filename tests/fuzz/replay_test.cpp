// The fuzz targets without libFuzzer: every input of the corpus, then mutations of it, the same each time. libFuzzer, which looks
// for new paths, goes deeper: tests/fuzz/run.
#include <fcntl.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <vector>

#include "stimuli/io/output_file.h"
#include "tests/fuzz/mutator.h"
#include "tests/fuzz/target.h"

namespace stairstep::fuzz {
namespace {

namespace fs = std::filesystem;
using Clock = std::chrono::steady_clock;

/// As many on every machine, and under sanitizers: a few seconds a target.
constexpr int kMutations = 3000;
/// What a file of this size may take, sanitizers and a busy machine allowed for.
constexpr std::chrono::seconds kHang{20};

/// The input that is being run, in a file of the working folder: left there by a run that dies, for the corpus.
class LastInput {
  public:
    explicit LastInput(const std::string& target)
        : path_(fs::absolute("fuzz-" + target + "-" + std::to_string(getpid()) + ".last")),
          file_(open(path_.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0644)) {}
    ~LastInput() {
        close(file_);
        std::error_code ignored;
        if (!keep_) fs::remove(path_, ignored);
    }
    LastInput(const LastInput&) = delete;
    LastInput& operator=(const LastInput&) = delete;

    void set(std::string_view input) const {
        const bool written = ftruncate(file_, 0) == 0 &&
                             pwrite(file_, input.data(), input.size(), 0) == static_cast<ssize_t>(input.size());
        ASSERT_TRUE(written) << path_;
    }
    /// The file's name, for a message; it stays.
    std::string keep() {
        keep_ = true;
        return path_.string();
    }

  private:
    fs::path path_;
    int file_;
    bool keep_ = false;
};

class Fuzz : public testing::TestWithParam<Target> {
  protected:
    static std::vector<std::string> corpus() {
        std::vector<fs::path> paths;
        for (const auto& entry : fs::directory_iterator(fs::path(STAIRSTEP_CORPUS) / GetParam().name)) {
            paths.push_back(entry.path());
        }
        std::sort(paths.begin(), paths.end());
        std::vector<std::string> inputs;
        for (const fs::path& path : paths) inputs.push_back(read_file(path));
        return inputs;
    }

    /// False where the input is a finding.
    bool holds(const std::string& input) {
        last_.set(input);
        const auto started = Clock::now();
        try {
            GetParam().run(input);
        } catch (const std::exception& e) {
            ADD_FAILURE() << e.what() << ": " << last_.keep();
            return false;
        }
        if (Clock::now() - started < kHang) return true;
        ADD_FAILURE() << "takes too long: " << last_.keep();
        return false;
    }

  private:
    LastInput last_{GetParam().name};
};

TEST_P(Fuzz, Corpus) {
    const std::vector<std::string> inputs = corpus();
    ASSERT_GE(inputs.size(), 2u);
    for (const std::string& input : inputs) ASSERT_TRUE(holds(input));
    ASSERT_TRUE(holds(""));
}

TEST_P(Fuzz, Mutations) {
    const std::vector<std::string> inputs = corpus();
    Random random(1);
    for (int i = 0; i < kMutations; ++i) ASSERT_TRUE(holds(mutation(inputs, random))) << "mutation " << i;
}

INSTANTIATE_TEST_SUITE_P(Target, Fuzz, testing::ValuesIn(kTargets), [](const auto& info) { return info.param.name; });

}  // namespace

/// For messages and names of tests.
void PrintTo(const Target& target, std::ostream* out) {
    *out << target.name;
}

}  // namespace stairstep::fuzz
