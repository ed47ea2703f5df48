#include "stimuli/io/image_file.h"

#include <gtest/gtest.h>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

TEST(ImageFile, ReadsBackEveryLevel) {
    const TemporaryFolder folder;
    Image image(16, 16, 1);
    for (int i = 0; i < 256; ++i) image.pixels[i] = static_cast<uint8_t>(i);
    write_png(folder.path() / "levels.png", image, {{"ImageDescription", "all levels"}});
    EXPECT_EQ(read_image(folder.path() / "levels.png").pixels, image.pixels);
}

TEST(ImageFile, LeavesNothingUnderTheFinalNameWhenItFails) {
    const TemporaryFolder folder;
    EXPECT_THROW(write_png(folder.path() / "absent" / "x.png", Image(2, 2, 1)), FailureError);
    EXPECT_TRUE(std::filesystem::is_empty(folder.path()));
}

TEST(ImageFile, RefusesDamagedFiles) {
    const TemporaryFolder folder;
    Image image(64, 64, 3);
    for (size_t i = 0; i < image.pixels.size(); ++i) image.pixels[i] = static_cast<uint8_t>(i * 7919 >> 3);
    write_png(folder.path() / "whole.png", image);
    const std::string bytes = read_file(folder.path() / "whole.png");
    for (const size_t size : {size_t{0}, size_t{4}, size_t{20}, bytes.size() / 2}) {
        write_file(folder.path() / "cut.png", std::string_view(bytes).substr(0, size));
        EXPECT_THROW(read_image(folder.path() / "cut.png"), InputError) << size << " bytes";
    }
    EXPECT_THROW(read_image(folder.path() / "absent.png"), InputError);
    EXPECT_THROW(read_image(folder.path()), InputError);
}

}  // namespace
}  // namespace stairstep
