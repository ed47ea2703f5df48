#include "stimuli/io/stored_image.h"

#include <OpenImageIO/filesystem.h>
#include <OpenImageIO/imageio.h>

#include <cassert>
#include <cstdint>

#include "stimuli/error.h"
#include "stimuli/io/output_file.h"
#include "stimuli/stimulus.h"

namespace stairstep {
namespace fs = std::filesystem;
namespace {

OIIO::TypeDesc type_of(int bits) {
    assert(bits == 8 || bits == 16 || bits == 32);
    return bits == 8 ? OIIO::TypeDesc::UINT8 : bits == 16 ? OIIO::TypeDesc::UINT16 : OIIO::TypeDesc::FLOAT;
}

/// Writes values of the file's own type, so that OpenImageIO converts nothing.
bool write_values(OIIO::ImageOutput& writer, const StoredImage& image) {
    const auto write_as = [&]<typename T>(T) {
        const std::vector<T> values(image.values.begin(), image.values.end());
        return writer.write_image(type_of(image.bits), values.data());
    };
    if (image.bits == 8) return write_as(uint8_t{});
    if (image.bits == 16) return write_as(uint16_t{});
    return writer.write_image(type_of(image.bits), image.values.data());
}

bool read_values(OIIO::ImageInput& reader, StoredImage& image) {
    const auto read_as = [&]<typename T>(T) {
        std::vector<T> values(image.values.size());
        const bool read = reader.read_image(0, 0, 0, 1, type_of(image.bits), values.data());
        image.values.assign(values.begin(), values.end());
        return read;
    };
    if (image.bits == 8) return read_as(uint8_t{});
    if (image.bits == 16) return read_as(uint16_t{});
    return reader.read_image(0, 0, 0, 1, type_of(image.bits), image.values.data());
}

}  // namespace

void write_stored_image(const fs::path& path, const StoredImage& image, const std::string& description) {
    const auto fail = [&path](const std::string& reason) {
        throw FailureError(path.string(), "can't be encoded (" + reason + ")", "install OpenImageIO with this format");
    };
    OIIO::ImageSpec spec(image.width_px, image.height_px, 1, type_of(image.bits));
    spec.attribute("ImageDescription", description);
    spec.attribute("Software", "Stairstep " STAIRSTEP_VERSION);
    // Left to themselves, the TIFF and EXR writers store the time of writing.
    spec.attribute("DateTime", "");

    // Encoded in memory: not every library that OpenImageIO stands on reports a full disk.
    std::vector<unsigned char> bytes;
    OIIO::Filesystem::IOVecOutput memory(bytes);
    const auto writer = OIIO::ImageOutput::create(path.filename().string());
    if (!writer) fail(OIIO::geterror());
    if (!writer->set_ioproxy(&memory) || !writer->open(path.filename().string(), spec) ||
        !write_values(*writer, image) || !writer->close()) {
        fail(writer->geterror());
    }
    write_file(path, {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
}

StoredImage read_stored_image(const fs::path& path) {
    std::error_code error;
    if (!fs::exists(path, error)) throw InputError(path.string(), "doesn't exist", "check the path");
    if (!fs::is_regular_file(path, error)) throw InputError(path.string(), "is no file", "name an image file");
    const auto reader = OIIO::ImageInput::open(path.string());
    if (!reader) {
        throw InputError(path.string(), "can't be read as an image (" + OIIO::geterror() + ")", "write it again");
    }
    const OIIO::ImageSpec& spec = reader->spec();
    const bool is_stored =
        spec.nchannels == 1 && (spec.format == type_of(8) || spec.format == type_of(16) || spec.format == type_of(32));
    const auto is_side = [](int side) { return side >= 1 && side <= kLargestSide; };
    if (!is_stored || !is_side(spec.width) || !is_side(spec.height)) {
        throw InputError(path.string(),
                         "holds " + std::to_string(spec.width) + "x" + std::to_string(spec.height) + " px of " +
                             std::to_string(spec.nchannels) + " channels, " + spec.format.c_str(),
                         "stimuli have one channel of 8 or 16 bits or floats, and sides up to 16384 px");
    }
    const int bits = spec.format == type_of(8) ? 8 : spec.format == type_of(16) ? 16 : 32;
    StoredImage image{spec.width, spec.height, bits, {}};
    image.values.resize(static_cast<size_t>(spec.width) * spec.height);
    // The TIFF reader calls a strip that ends early read, and complains.
    if (!read_values(*reader, image) || reader->has_error()) {
        throw InputError(path.string(), "is damaged (" + reader->geterror() + ")", "write it again");
    }
    return image;
}

std::optional<std::string> stored_description(const fs::path& path) {
    std::error_code error;
    if (!fs::is_regular_file(path, error)) return std::nullopt;
    const auto reader = OIIO::ImageInput::open(path.string());
    if (!reader) {
        OIIO::geterror();  // or the next failure on this thread would name this one
        return std::nullopt;
    }
    const OIIO::ParamValue* description = reader->spec().find_attribute("ImageDescription", OIIO::TypeDesc::STRING);
    if (!description) return std::nullopt;
    return description->get_string();
}

}  // namespace stairstep
