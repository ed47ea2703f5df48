#include "stimuli/io/output_file.h"

#include <gtest/gtest.h>
#include <sys/stat.h>

#include <fstream>

#include "stimuli/error.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

TEST(OutputFile, AppearsOnlyOnCommit) {
    const TemporaryFolder folder;
    const auto path = folder.path() / "out.txt";
    {
        OutputFile abandoned(path);
        std::ofstream(abandoned.path()) << "half";
        EXPECT_FALSE(std::filesystem::exists(path));
    }
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));

    write_file(path, "first");
    {
        OutputFile abandoned(path);
        std::ofstream(abandoned.path()) << "half of the second";
    }
    EXPECT_EQ(read_file(path), "first");
    write_file(path, "second");
    EXPECT_EQ(read_file(path), "second");
}

TEST(OutputFile, PartialFilesAreKnownByTheirNames) {
    const TemporaryFolder folder;
    const OutputFile output(folder.path() / "step_r17.5.png");
    EXPECT_EQ(partial_file_stem(output.path().filename().string()), "step_r17.5");
    for (const char* other : {"step_r17.5.png", "step.partial-1.png", ".partial-1.png", ".hidden", ""}) {
        EXPECT_EQ(partial_file_stem(other), std::nullopt) << other;
    }
}

TEST(OutputFile, IsItsOwnersAloneFromTheStart) {
    const TemporaryFolder folder;
    const auto mode = [](const std::filesystem::path& path) { return std::filesystem::status(path).permissions(); };
    const mode_t before = umask(0);
    {
        OutputFile secret(folder.path() / "a", Access::owner_only);
        EXPECT_EQ(mode(secret.path()), std::filesystem::perms(0600));  // before anything is in it
        std::ofstream(secret.path()) << "x";
        secret.commit();
        write_file(folder.path() / "b", "x");
        make_output_folder(folder.path() / "c/d/", Access::owner_only);
        make_output_folder(folder.path() / "e");
        make_output_folder(folder.path() / "e/f", Access::owner_only);
    }
    umask(before);
    EXPECT_EQ(mode(folder.path() / "a"), std::filesystem::perms(0600));
    EXPECT_EQ(mode(folder.path() / "b"), std::filesystem::perms(0666));
    EXPECT_EQ(mode(folder.path() / "c"), std::filesystem::perms(0700));
    EXPECT_EQ(mode(folder.path() / "c/d"), std::filesystem::perms(0700));
    EXPECT_EQ(mode(folder.path() / "e"), std::filesystem::perms(0777));
    EXPECT_EQ(mode(folder.path() / "e/f"), std::filesystem::perms(0700));
    EXPECT_THROW(make_output_folder("/proc/self/stairstep/x", Access::owner_only), FailureError);
    EXPECT_THROW(make_output_folder(folder.path() / "a/x", Access::owner_only), FailureError);
}

TEST(OutputFile, SaysWhyItCannotBe) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_file(folder.path() / "absent" / "x", ""), FailureError);
    EXPECT_THROW(write_file(folder.path(), ""), FailureError);
    EXPECT_THROW(make_output_folder("/proc/self/stairstep"), FailureError);
    write_file(folder.path() / "file", "");
    EXPECT_THROW(make_output_folder(folder.path() / "file"), FailureError);
    EXPECT_THROW(read_file(folder.path() / "absent"), InputError);
    EXPECT_THROW(read_file(folder.path()), InputError);
}

}  // namespace
}  // namespace stairstep
