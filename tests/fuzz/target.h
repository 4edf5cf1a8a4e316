#pragma once

// What every fuzz target has in common. A target is one file that defines LLVMFuzzerTestOneInput
// for one reader of outside input: it gives the bytes to the reader, and checks what holds of
// whatever the reader makes of them. libFuzzer calls it with inputs of its making; in builds
// without it, replay.cpp calls it with the files it is given (docs/reliability.md).

#include <cstddef>
#include <cstdint>
#include <string_view>

#include "cases/case.h"
#include "cases/error.h"

// libFuzzer's own declaration of the entry.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace rastercheck::fuzz {

/// The bytes of an input.
std::string_view text_of(const std::uint8_t* data, std::size_t size);

/// Ends the process by abort() where a property does not hold: that is a finding.
void expect(bool holds, std::string_view property);

/// Whether a text has no control character of Unicode's (U+0000…U+001F, U+007F…U+009F): a terminal
/// shows it as it is, on one line.
bool is_one_line(std::string_view text);

/// What is refused is refused in one line, with a reason.
void expect_one_line(const Error& error);

/// A case that was read is the same to the bit when it is written and read again.
void expect_round_trip(const cases::Case& c);

}  // namespace rastercheck::fuzz
