#include "stimuli/io/stored_image.h"

#include <gtest/gtest.h>

#include <cmath>

#include "stimuli/error.h"
#include "stimuli/io/image_encoding.h"
#include "stimuli/io/output_file.h"
#include "stimuli/io/temporary_folder.h"

namespace stairstep {
namespace {

struct Kind {
    const char* extension;
    int bits;
};

void PrintTo(const Kind& kind, std::ostream* stream) {
    *stream << kind.extension << kind.bits;
}

class EveryKind : public testing::TestWithParam<Kind> {
  protected:
    std::filesystem::path file(const std::string& stem) const {
        return folder_.path() / (stem + "." + GetParam().extension);
    }
    TemporaryFolder folder_;
};

constexpr const char* kDescription = "pattern=step;radius_px=17.5;transfer=gamma=2.2;pixels_per_degree=";

TEST_P(EveryKind, ReadsBackEveryValueAndItsDescription) {
    const int bits = GetParam().bits;
    StoredImage image{256, bits == 8 ? 1 : 256, bits, {}};
    const int count = image.width_px * image.height_px;
    // All levels there are; floats that no integer depth has.
    for (int i = 0; i < count; ++i) {
        image.values.push_back(bits == 32 ? static_cast<float>(std::sqrt(i / (count - 1.0))) : static_cast<float>(i));
    }
    write_stored_image(file("all"), image, kDescription);
    EXPECT_EQ(read_stored_image(file("all")), image);
    EXPECT_EQ(stored_description(file("all")), kDescription);
}

TEST_P(EveryKind, TheSameImageIsTheSameBytesAtAnotherTime) {
    const StoredImage image{5, 3, GetParam().bits, std::vector<float>(15, 1)};
    write_stored_image(file("a"), image, kDescription);
    const std::string first = read_file(file("a"));
    // Formats that keep times keep seconds; a year would show as well.
    EXPECT_EQ(first.find("202"), std::string::npos);
    write_stored_image(file("a"), image, kDescription);
    EXPECT_EQ(read_file(file("a")), first);
}

TEST_P(EveryKind, RefusesDamagedFiles) {
    StoredImage image{64, 64, GetParam().bits, {}};
    for (int i = 0; i < 64 * 64; ++i) image.values.push_back(static_cast<float>(i * 7919 % 251));
    write_stored_image(file("whole"), image, kDescription);
    const std::string bytes = read_file(file("whole"));
    for (const size_t size : {size_t{0}, size_t{20}, bytes.size() / 2}) {
        write_file(file("cut"), std::string_view(bytes).substr(0, size));
        EXPECT_THROW(read_stored_image(file("cut")), InputError) << size << " bytes";
    }
    EXPECT_EQ(stored_description(file("absent")), std::nullopt);
    EXPECT_THROW(read_stored_image(file("absent")), InputError);
}

TEST_P(EveryKind, HoldsTheStimulussExactValues) {
    // Unfiltered: black, and C = 1/2 stored through sRGB as 0.7353570, level 187.516 of 255 or 48191.62 of 65535.
    const Stimulus stimulus{.contrast = 0.5, .width_px = 16, .height_px = 16};
    const ImageEncoding encoding{*image_format_named(GetParam().extension), GetParam().bits, *Transfer::named("srgb"),
                                 Dither::none};
    write_stored_image(file("s"), encode(stimulus, luminance(stimulus), encoding), "");
    const StoredImage image = read_stored_image(file("s"));
    const float lit = GetParam().bits == 8 ? 188 : GetParam().bits == 16 ? 48192 : 0.7353570f;
    EXPECT_FLOAT_EQ(image.values.front(), lit);
    EXPECT_EQ(image.values.back(), 0);
}

INSTANTIATE_TEST_SUITE_P(StoredImage, EveryKind,
                         testing::Values(Kind{"png", 8}, Kind{"png", 16}, Kind{"tif", 8}, Kind{"tif", 16},
                                         Kind{"exr", 32}),
                         testing::PrintToStringParamName());

TEST(ImageEncoding, KnowsWhichDepthsAFormatHas) {
    for (const ImageFormat format : {ImageFormat::png, ImageFormat::tif, ImageFormat::exr}) {
        EXPECT_EQ(image_format_named(name(format)), format);
        for (const int bits : {0, 8, 16, 32}) {
            const bool exists = format == ImageFormat::exr ? bits == 32 : bits == 8 || bits == 16;
            if (exists) {
                EXPECT_NO_THROW(require_valid(ImageEncoding{format, bits}));
            } else {
                EXPECT_THROW(require_valid(ImageEncoding{format, bits}), InputError) << name(format) << bits;
            }
        }
    }
    EXPECT_THROW(require_valid(ImageEncoding{ImageFormat::exr, 32, {}, Dither::ordered}), InputError);
}

TEST(ImageEncoding, ExactIsTheEncodedExactLuminance) {
    for (const KernelShape shape : {KernelShape::box, KernelShape::disk, KernelShape::gaussian, KernelShape::poisson}) {
        for (const Pattern pattern : {Pattern::step, Pattern::stair}) {
            for (const ImageEncoding& encoding :
                 {ImageEncoding{}, ImageEncoding{ImageFormat::tif, 16}, ImageEncoding{ImageFormat::exr, 32},
                  ImageEncoding{ImageFormat::png, 8, *Transfer::named("gamma=2.2")},
                  ImageEncoding{ImageFormat::png, 8, {}, Dither::error_diffusion}}) {
                const Stimulus stimulus{.pattern = pattern,
                                        .silhouette = pattern,
                                        .kernel = {.shape = shape, .radius_px = 23},
                                        .contrast = 0.5,
                                        .width_px = 160,
                                        .height_px = 120};
                EXPECT_EQ(encode_exact(stimulus, encoding), encode(stimulus, luminance(stimulus), encoding))
                    << file_stem(stimulus) << " " << encoding.bits;
            }
        }
    }
}

}  // namespace
}  // namespace stairstep
