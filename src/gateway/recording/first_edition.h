// Recordings of the first edition, which named one receiver, one sensor, one battery and one chip
// by their kind and not by number: their inputs, as the second edition writes them.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "gateway/slots.h"

namespace drover::gateway {

/// The record of an input in the second edition; empty when it is none of the first.
std::vector<std::uint8_t> from_first_edition(std::span<const std::uint8_t> record,
                                             const Wiring& wiring);

/// The byte streams of an output in the first edition, in their order; kNowhere: not configured.
std::vector<LinkId> streams_of_first_edition(const Wiring& wiring);

}  // namespace drover::gateway
