// Looks into the table of drivers.
#include "drover/registry.h"

namespace drover {

const DriverEntry* find_driver(std::string_view name) {
  for (const DriverEntry& entry : driver_registry())
    if (entry.name == name) return &entry;
  return nullptr;
}

const DriverEntry* find_driver(std::string_view name, SlotKind kind) {
  const DriverEntry* const entry = find_driver(name);
  return entry != nullptr && entry->kind == kind ? entry : nullptr;
}

}  // namespace drover
