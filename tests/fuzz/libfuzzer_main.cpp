// One target under libFuzzer; STAIRSTEP_FUZZ_TARGET is its function.
#include <cstddef>
#include <cstdint>

#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* data, size_t size) {
    stairstep::fuzz::STAIRSTEP_FUZZ_TARGET({reinterpret_cast<const char*>(data), size});
    return 0;
}
