#include "stimuli/io/image_file.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imagebuf.h>
#include <OpenImageIO/imagebufalgo.h>
#include <OpenImageIO/imageio.h>

#include <string_view>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/stimulus.h"

namespace stairstep {

namespace {

/// OpenImageIO's name of what starts with these bytes; empty for none.
std::string_view format_of(std::span<const uint8_t> bytes) {
    struct Magic {
        std::string_view bytes;
        std::string_view format;
    };
    using namespace std::string_view_literals;
    constexpr Magic kMagics[] = {{"\x89PNG"sv, "png"}, {"\xff\xd8\xff"sv, "jpeg"}, {"BM"sv, "bmp"},
                                 {"GIF8"sv, "gif"},    {"II*\0"sv, "tiff"},        {"MM\0*"sv, "tiff"},
                                 {"DDS "sv, "dds"},    {"RIFF"sv, "webp"}};
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), bytes.size());
    for (const Magic& magic : kMagics) {
        if (text.starts_with(magic.bytes)) return magic.format;
    }
    return {};
}

/// Checks what an opened file claims and reads its first image.
Image read_first_image(OIIO::ImageInput& reader, const std::string& subject) {
    const OIIO::ImageSpec& spec = reader.spec();
    if (spec.width < 1 || spec.height < 1 || spec.width > kLargestSide || spec.height > kLargestSide) {
        throw InputError(subject, "claims " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " px",
                         "each side must be 1 to 16384 px");
    }
    const int channels = spec.nchannels >= 3 ? 3 : 1;
    Image image(spec.width, spec.height, channels);
    if (!reader.read_image(0, 0, 0, channels, OIIO::TypeDesc::UINT8, image.pixels.data())) {
        throw InputError(subject, "is damaged (" + reader.geterror() + ")", "write it again");
    }
    return image;
}

}  // namespace

void write_png(const std::filesystem::path& path, const Image& image, const ImageAttributes& attributes) {
    OutputFile output(path);
    OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    for (const auto& [name, value] : attributes) spec.attribute(name, value);
    const auto writer = OIIO::ImageOutput::create("png");
    if (!writer) throw FailureError(path.string(), OIIO::geterror(), "install OpenImageIO with PNG support");
    if (!writer->open(output.path().string(), spec) ||
        !writer->write_image(OIIO::TypeDesc::UINT8, image.pixels.data()) || !writer->close()) {
        throw FailureError(path.string(), "can't be written (" + writer->geterror() + ")",
                           "check the disk's free space");
    }
    output.commit();
}

Image read_image(const std::filesystem::path& path) {
    if (!std::filesystem::exists(path)) throw InputError(path.string(), "doesn't exist", "check the path");
    // Given a folder, one of OpenImageIO's readers takes memory without end.
    if (!std::filesystem::is_regular_file(path)) throw InputError(path.string(), "is no file", "name an image file");
    const auto reader = OIIO::ImageInput::open(path.string());
    if (!reader) {
        throw InputError(path.string(), "can't be read as an image (" + OIIO::geterror() + ")", "check the file");
    }
    return read_first_image(*reader, path.string());
}

Image decode_image(std::span<const uint8_t> bytes, const std::string& subject) {
    const std::string_view format = format_of(bytes);
    if (format.empty()) throw InputError(subject, "is no image format that is known", "use PNG or JPEG");
    OIIO::Filesystem::IOMemReader memory(const_cast<uint8_t*>(bytes.data()), bytes.size());
    const auto reader = OIIO::ImageInput::create(format);
    // A reader that can't read from memory would look for a file of the subject's name.
    if (!reader || !reader->supports("ioproxy") || !reader->set_ioproxy(&memory)) {
        throw InputError(subject, "is " + std::string(format) + ", which can't be read from memory", "use PNG or JPEG");
    }
    OIIO::ImageSpec spec;
    if (!reader->open(subject, spec)) {
        throw InputError(subject, "can't be read as an image (" + reader->geterror() + ")", "check the file");
    }
    return read_first_image(*reader, subject);
}

bool draw_text(Image& image, int column, int row, const std::string& text, int size_px, uint8_t grey) {
    const OIIO::ImageSpec spec(image.width, image.height, image.channels, OIIO::TypeDesc::UINT8);
    OIIO::ImageBuf buffer(spec, image.pixels.data());
    const std::vector<float> colour(image.channels, grey / 255.0f);
    return OIIO::ImageBufAlgo::render_text(buffer, column, row, text, size_px, "DejaVuSans", colour);
}

}  // namespace stairstep
