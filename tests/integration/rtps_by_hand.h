// What DDS says on the wire, written by hand: one who never listens can say it, too.
#pragma once

#include <array>
#include <cstdint>
#include <span>
#include <string_view>
#include <vector>

namespace drover::test::rtps {

using Bytes = std::vector<std::uint8_t>;
using Guid = std::array<std::uint8_t, 16>;  ///< of which the last four name a reader or writer

/// A participant says that he is there, to be answered at 127.0.0.1.
Bytes participant(const Guid& writer, int domain);
/// He says that he writes this topic, best effort.
Bytes publication(const Guid& writer, std::string_view topic, std::string_view type);
/// He writes a sample: to every reader of the topic. `sample`: with the header of its
/// encapsulation.
Bytes data(const Guid& writer, std::uint32_t number, std::span<const std::uint8_t> sample);

}  // namespace drover::test::rtps
