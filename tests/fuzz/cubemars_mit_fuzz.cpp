// A CubeMars motor's driver, as mit_bench.h tells.
#include "drivers/cubemars_mit/driver.h"
#include "tests/fuzz/mit_bench.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace drover;
  fuzz::Input input({data, size});
  Options options(cubemars_mit::option_table());
  options.set("id", 1.0).set("model", std::string("AK80-9")).set("settle_s", 0.0);
  if (input.byte() % 2 != 0) options.set("master_id", 0.0);
  cubemars_mit::CubemarsDriver driver(cubemars_mit::read_settings(options), 0);
  fuzz::drive_mit(driver, {0x001, 0x001, 0x002, 0x000}, input);
  return 0;
}
