// What goes in and out, in words: for the difference that a replay finds, and events in a
// recording. Allocates nothing where it gives a Line.
#pragma once

#include <span>
#include <string>

#include "drover/can_frame.h"
#include "drover/event.h"
#include "gateway/recording/bytes.h"

namespace drover::gateway {

using Line = FixedText<512>;

/// All of it, exactly: two events with one text are equal.
Line text_of(const Event& event);
/// `021#0000000008000000`, as candump writes it.
Line text_of(const CanFrame& frame);
/// Hexadecimal, `...` where it is long.
std::string text_of(std::span<const std::uint8_t> bytes);

void write_frame(const CanFrame& frame, ByteWriter& out);
/// The reader is bad when it is no such frame.
CanFrame read_frame(ByteReader& in);

}  // namespace drover::gateway
