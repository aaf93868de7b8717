// Recordings of earlier editions: their inputs, as they are written today. The first named one
// receiver, one sensor, one battery and one chip by their kind and not by number; the first two did
// not tell whether a robot that was remembered was at rest, the first three not whether a wheel of
// it had run away, the first four not where it stood; the first five knew no more of cmd_vel's
// twists than their speeds, and the first six none to the side. All before the ninth told in words
// only who sent joint commands before this program, or their way, was there.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gateway/slots.h"

namespace drover::gateway {

/// The record of an input of the first edition as it is written today; empty when it is none.
std::vector<std::uint8_t> from_first_edition(std::span<const std::uint8_t> record,
                                             const Wiring& wiring);

/// The same of the later ones.
std::vector<std::uint8_t> from_second_edition(std::span<const std::uint8_t> record);
std::vector<std::uint8_t> from_third_edition(std::span<const std::uint8_t> record);
std::vector<std::uint8_t> from_fourth_edition(std::span<const std::uint8_t> record);
std::vector<std::uint8_t> from_fifth_edition(std::span<const std::uint8_t> record);
/// Of all up to the sixth, after what is done for the one that it is of.
std::vector<std::uint8_t> from_sixth_edition(std::span<const std::uint8_t> record);
std::vector<std::uint8_t> from_seventh_edition(std::span<const std::uint8_t> record);
std::vector<std::uint8_t> from_eighth_edition(std::span<const std::uint8_t> record);

/// The byte streams of an output in the first edition, in their order; kNowhere: not configured.
std::vector<LinkId> streams_of_first_edition(const Wiring& wiring);

}  // namespace drover::gateway
