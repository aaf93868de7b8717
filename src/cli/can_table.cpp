#include "cli/can_table.h"

#include <cstdio>
#include <ostream>

#include "json/json_text.h"

namespace drover::cli {

namespace {

std::string hex(std::uint32_t value, int digits) {
  char out[16];
  std::snprintf(out, sizeof out, "%0*X", digits, value);
  return out;
}

std::string data_of(const CanFrame& frame) {
  if (frame.remote) return "remote";
  std::string out;
  for (const auto byte : frame.payload()) out += hex(byte, 2);
  return out;
}

}  // namespace

void CanTable::add(const LoggedFrame& logged) {
  auto& row = rows_[{logged.bus, logged.frame.error, logged.frame.extended, logged.frame.id}];
  if (row.count++ == 0) row.first = logged.time;
  row.last = logged.time;
  row.frame = logged.frame;
  ++frames_;
}

void CanTable::print(std::ostream& out, bool json) const {
  if (!json) out << "bus       id          frames          rate  bytes  last\n";
  for (const auto& [key, row] : rows_) {
    const auto& [bus, error, extended, id] = key;
    const double span_s = to_s(row.last - row.first);
    const bool paced = row.count > 1 && span_s > 0;
    const double rate_Hz = paced ? static_cast<double>(row.count - 1) / span_s : 0;
    const auto name = hex(id, extended ? 8 : 3);
    if (json) {
      json::JsonText text;
      text.open('{')
          .key("ok")
          .boolean(true)
          .key("bus")
          .text(bus)
          .key("id")
          .text(name)
          .key("error")
          .boolean(error);
      text.key("frames").integer(static_cast<std::int64_t>(row.count)).key("rate_Hz");
      if (paced) {
        text.number(rate_Hz);
      } else {
        text.null();
      }
      text.key("bytes").integer(row.frame.len).key("last").text(data_of(row.frame)).close('}');
      out << text.str() << '\n';
      continue;
    }
    char rate[32] = "-";
    if (paced) std::snprintf(rate, sizeof rate, "%.1f Hz", rate_Hz);
    char line[128];
    std::snprintf(line, sizeof line, "%-9s %-8s %9llu  %12s  %5u  ", bus.c_str(), name.c_str(),
                  static_cast<unsigned long long>(row.count), rate,
                  static_cast<unsigned>(row.frame.len));
    out << line << data_of(row.frame) << (error ? "  ERROR FRAME" : "") << '\n';
  }
}

}  // namespace drover::cli
