// Decodes rounds of recorded registers, as far as they go, through the driver that droverd uses.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "cli/register_log.h"
#include "drover/driver.h"
#include "drover/register_map.h"

namespace drover::cli {

/// `map` with only the values whose registers are all in `image`.
RegisterMap part_of(const RegisterMap& map, const RegisterImage& image);

class RoundDecoder final {
 public:
  using Make = std::function<Made(const RegisterMap&)>;
  RoundDecoder(Make make, const RegisterMap& map);

  /// By the device that it returns; nullptr: a round that holds nothing of the map.
  const Device* decode(const RegisterImage& image, Time now, DriverOut& out);
  /// Values of the map that no round held: "soc (0x12A6), temperature (0x129C)"; empty: none.
  std::string missing() const;
  std::uint64_t bad(Time now) const;
  /// What the driver says of the last round.
  std::string reason(Time now) const;

 private:
  using Held = std::vector<std::size_t>;  ///< how many neighbours of each field, and which alarms

  Make make_;
  RegisterMap map_;
  std::map<Held, Made> drivers_;  ///< each remembers its own rounds
  Device* last_ = nullptr;
  std::vector<bool> seen_;  ///< by field
};

}  // namespace drover::cli
