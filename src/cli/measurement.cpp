#include "cli/measurement.h"

#include "cli/shown_text.h"
#include "json/json_text.h"
#include "publish/shown_json.h"

namespace drover::cli {

namespace {

/// A measurement is not of a robot that has an attitude of its own.
class MeasurementJson final : public publish::ShownJson {
 public:
  explicit MeasurementJson(json::JsonText& out) : ShownJson(out, kNever) {}
  void derived(const char* name, double value, const Shown&) {
    out_.key(name);
    number(value);
  }
};

template <class V>
void describe_all(V& v, const Measurement& measurement, const Reason& words) {
  std::visit(
      [&](const auto& value) {
        describe(v, value);
        describe_words(v, value, words);
      },
      measurement.value);
}

}  // namespace

std::string_view kind_of(const Measurement& measurement) {
  return std::visit(KindOfMeasurement{}, measurement.value);
}

std::string measurement_text(const Measurement& measurement, const Reason& words,
                             const Place& place) {
  ShownText out;
  describe_all(out, measurement, words);
  std::string head = fixed(place.value, place.decimals);
  if (head.size() < 8) head.insert(0, 8 - head.size(), ' ');
  if (!place.who.empty()) head += "  " + place.who;
  return head + "  " + std::string(kind_of(measurement)) + out.take();
}

std::string measurement_json(const Measurement& measurement, const Reason& words,
                             const Place& place) {
  json::JsonText out;
  out.open('{').key("ok").boolean(true).key(place.key);
  if (place.decimals == 0) {
    out.integer(static_cast<std::int64_t>(place.value));
  } else {
    out.number(place.value);
  }
  if (!place.who.empty()) out.key("device").text(place.who);
  out.key("kind").text(kind_of(measurement));
  MeasurementJson members(out);
  describe_all(members, measurement, words);
  out.close('}');
  return out.take();
}

}  // namespace drover::cli
