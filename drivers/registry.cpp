// The one table of drivers: an include and a line each.
#include "drover/registry.h"

#include <array>

#include "drivers/agilex_v2/entry.h"
#include "drivers/agilex_v2/hunter/entry.h"
#include "drivers/cia402/entry.h"
#include "drivers/cubemars_mit/entry.h"
#include "drivers/damiao/entry.h"
#include "drivers/gpio_line/entry.h"
#include "drivers/gt01/can/entry.h"
#include "drivers/gt01/serial/entry.h"
#include "drivers/hipnuc_can/entry.h"
#include "drivers/ld06/entry.h"
#include "drivers/modbus_bms/entry.h"
#include "drivers/nmea0183/entry.h"
#include "drivers/odrive/entry.h"
#include "drivers/robomaster_c620/entry.h"
#include "drivers/witmotion/entry.h"
#include "drivers/zlac8015d/entry.h"

namespace drover {

std::span<const DriverEntry> driver_registry() {
  // Filled at the first call: the entries live in other files, whose order of start is not ours.
  static const std::array kTable{
      kOdriveEntry,    kGpioLineEntry,       kNmea0183Entry,    kModbusBmsEntry,
      kWitmotionEntry, kZlac8015dEntry,      kGt01SerialEntry,  kGt01CanEntry,
      kAgilexV2Entry,  kHipnucCanEntry,      kLd06Entry,        kAgilexHunterEntry,
      kDamiaoEntry,    kRobomasterC620Entry, kCubemarsMitEntry, kCia402Entry,
  };
  return kTable;
}

}  // namespace drover
