// A DAMIAO motor's driver, as mit_bench.h tells.
#include "drivers/damiao/driver.h"
#include "tests/fuzz/mit_bench.h"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace drover;
  fuzz::Input input({data, size});
  Options options(damiao::option_table());
  options.set("id", 1.0).set("model", std::string("DM4310")).set("settle_s", 0.0);
  damiao::DamiaoDriver driver(damiao::read_settings(options), 0);
  fuzz::drive_mit(driver, {0x011, 0x001, 0x7FF, 0x012}, input);
  return 0;
}
