// A zone as text that is kept on disk: JSON of our own, whose numbers read back to the bit.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "drover/result.h"
#include "scene/message/refusal.h"
#include "scene/zone/zone.h"

namespace drover::scene {

/// In one line. The zone is good (check_zone).
std::string zone_text(const Zone& zone);

/// What is read is good (check_zone). An unknown key is refused: it may narrow what the rest says.
Result<Zone, Refusal> read_zone_text(std::string_view text);

/// What stands in the store, as zones. While a single one cannot be read the fence is not known:
/// no start.
struct KnownZones {
  std::vector<Zone> zones;
  std::vector<std::string> problems;  ///< a sentence each; empty: all are known
  bool known() const { return problems.empty(); }
};
KnownZones read_zone_texts(const std::vector<std::string>& texts);

}  // namespace drover::scene
