#include "store/learned_store.h"

#include <cerrno>

#include "drover/role.h"
#include "json/json_text.h"
#include "json/located_json.h"

namespace drover::store {
namespace {

constexpr std::string_view kLearnedFormat = "drover-learned";
constexpr int kLearnedVersion = 1;
const std::string kLearnedFile = "learned.json";
constexpr std::size_t kMostLearnedBytes = 65536;

std::optional<double> number_of(const json::Node& node, std::string_view key) {
  const auto* member = node.find(key);
  return member == nullptr ? std::nullopt : member->number();
}

/// The number of a receiver or inertial sensor.
std::optional<std::uint8_t> sensor_of(const json::Node& root, std::string_view key) {
  const auto number = number_of(root, key);
  if (!number || !(*number >= 0 && *number < kMaxOfKind)) return std::nullopt;
  return static_cast<std::uint8_t>(*number);
}

/// In hexadecimal: a number of JSON does not hold 64 bits everywhere.
std::optional<std::uint64_t> subject_of(const json::Node& root) {
  const auto* member = root.find("subject");
  const auto* text = member == nullptr ? nullptr : member->text();
  if (text == nullptr || text->size() != 16) return std::nullopt;
  std::uint64_t subject = 0;
  for (const char c : *text) {
    const bool digit = c >= '0' && c <= '9';
    if (!digit && !(c >= 'a' && c <= 'f')) return std::nullopt;
    subject = subject << 4U | static_cast<std::uint64_t>(digit ? c - '0' : c - 'a' + 10);
  }
  return subject;
}

std::string subject_text(std::uint64_t subject) {
  std::string text;
  for (int shift = 60; shift >= 0; shift -= 4) text += "0123456789abcdef"[subject >> shift & 15U];
  return text;
}

std::optional<KeptLearned> read_learned(const json::Node& root) {
  KeptLearned kept;
  const auto subject = subject_of(root);
  const auto wall_s = number_of(root, "wall_s");
  const auto receiver = sensor_of(root, "receiver");
  const auto imu = sensor_of(root, "imu");
  const auto* values = root.find("values");
  if (!subject || !wall_s || !receiver || !imu || values == nullptr) return std::nullopt;
  kept.subject = *subject;
  kept.wall_s = *wall_s;
  kept.values.receiver = *receiver;
  kept.values.imu = *imu;
  each_learned(kept.values, [values](const char* name, LearnedValue& value) {
    const auto* member = values->find(name);
    if (member == nullptr) return;
    const auto mean = number_of(*member, "value");
    const auto sigma = number_of(*member, "sigma");
    if (mean && sigma) value = {*mean, *sigma};
  });
  return kept;
}

}  // namespace

LearnedStore::LearnedStore(Files& files, std::string folder)
    : files_(files), folder_(std::move(folder)) {}

std::optional<KeptLearned> LearnedStore::load(std::vector<std::string>& report) const {
  const std::string path = folder_ + "/" + kLearnedFile;
  std::string content;
  if (const int e = files_.read(path, kMostLearnedBytes, content); e == ENOENT) {
    return std::nullopt;
  } else if (e != 0) {
    report.push_back(failure_text("read", path, e) + ": the robot learns anew");
    return std::nullopt;
  }
  std::string what = "does not tell what was learned";
  const auto body = unseal(kLearnedFormat, kLearnedVersion, content);
  if (body.ok()) {
    const auto parsed = json::parse(*body);
    auto kept = parsed.ok() ? read_learned(parsed->root) : std::nullopt;
    if (kept) return kept;
  } else {
    what = body.error().text;
  }
  report.push_back(path + " " + what + ": the robot learns anew; " +
                   put_aside(files_, folder_, kLearnedFile));
  return std::nullopt;
}

std::optional<Failure> LearnedStore::save(const KeptLearned& kept) {
  json::JsonText body;
  body.open('{').key("subject").text(subject_text(kept.subject));
  body.key("wall_s").number(kept.wall_s);
  body.key("receiver").integer(kept.values.receiver);
  body.key("imu").integer(kept.values.imu);
  body.key("values").open('{');
  each_learned(kept.values, [&body](const char* name, const LearnedValue& value) {
    if (!value.known()) return;
    body.key(name).open('{').key("value").number(value.value);
    body.key("sigma").number(value.sigma).close('}');
  });
  body.close('}').close('}');
  return write_durably(files_, folder_, kLearnedFile,
                       seal(kLearnedFormat, kLearnedVersion, body.str()));
}

}  // namespace drover::store
