// What a register map says twice, and addresses that are counted another way.
#pragma once

#include <string>
#include <vector>

#include "config/fields_map.h"
#include "drover/register_map.h"

namespace drover::config {

/// Of the entry `index` of a list of the map file.
struct MapFinding {
  const char* list;
  std::size_t index;
  const char* key;
  std::string message;
  std::string hint;
};

/// Values that take each other's registers, and alarms of one bit. `map` is what `file` became.
std::vector<MapFinding> register_conflicts(const MapFile& file, const RegisterMap& map);

/// Whether sheets count registers in this range: 30001 is the first of function 4, 40001 of 3.
bool is_as_in_sheets(int address);
/// What is said of such an address; `others` are as many as there are besides.
MapFinding as_in_sheets(const char* list, std::size_t index, int address, std::size_t others);

}  // namespace drover::config
