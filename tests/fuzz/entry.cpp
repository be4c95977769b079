// SPDX-License-Identifier: MIT
// Where libFuzzer enters: `scons fuzz` compiles this once for each FUZZ_TARGET. In the tests it is empty.
#ifdef FUZZ_TARGET
#include "fuzz/targets.h"

#include <cstddef>
#include <cstdint>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t *data, std::size_t size) {
	softbody::fuzzing::FUZZ_TARGET({ data, size });
	return 0;
}
#endif
