#include "cli/rates.h"

#include <cmath>
#include <limits>

#include "cli/layout.h"
#include "json/json_text.h"

namespace drover::cli {

namespace {

using json::Node;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

double number(const Node& node) {
  return node.number().value_or(kNone);
}

void put(Node& object, std::string key, double value) {
  auto* members = std::get_if<std::vector<json::Member>>(&object.value);
  if (members == nullptr) return;
  Node node;
  if (std::isfinite(value)) node.value = value;
  members->push_back({std::move(key), 0, 0, std::move(node)});
}

Node* find(Node& object, std::string_view key) {
  auto* members = std::get_if<std::vector<json::Member>>(&object.value);
  if (members == nullptr) return nullptr;
  for (auto& member : *members)
    if (member.key == key) return &member.node;
  return nullptr;
}

/// Where the samples carry their instant, the pace is exact however far the answers are apart.
void add_sample_rate(Node& now, const Node& before, double now_s, double before_s) {
  const double count = number(at(now, "samples")) - number(at(before, "samples"));
  const double span_s =
      (now_s - number(at(now, "age_s"))) - (before_s - number(at(before, "age_s")));
  put(now, "rate_Hz", count > 0 && span_s > 0 ? count / span_s : kNone);
}

void add_link_rates(Node& now, const Node& before, double span_s) {
  for (const auto* key : {"received", "sent", "dropped", "refused"}) {
    const double count = number(at(now, key)) - number(at(before, key));
    put(now, std::string(key) + "_Hz", count >= 0 && span_s > 0 ? count / span_s : kNone);
  }
}

/// The entry of the earlier list with the same `key`; a node without a value when there is none.
const Node& same(const Node& list, const Node& entry, std::string_view key) {
  static const Node kNothing;
  if (list.list() == nullptr) return kNothing;
  for (const auto& each : *list.list())
    if (text(at(each, key)) == text(at(entry, key))) return each;
  return kNothing;
}

void write(json::JsonText& out, const Node& node) {
  if (node.is_null()) {
    out.null();
  } else if (const auto* flag = node.boolean()) {
    out.boolean(*flag);
  } else if (const auto whole = node.integer()) {
    out.integer(*whole);
  } else if (const auto value = node.number()) {
    out.number(*value);
  } else if (const auto* words = node.text()) {
    out.text(*words);
  } else if (const auto* list = node.list()) {
    out.open('[');
    for (const auto& item : *list) write(out, item);
    out.close(']');
  } else if (const auto* members = node.object()) {
    out.open('{');
    for (const auto& member : *members) {
      out.key(member.key);
      write(out, member.node);
    }
    out.close('}');
  }
}

}  // namespace

void add_rates(Node& status, const Node& before) {
  const double now_s = number(at(status, "time_s"));
  const double before_s = number(at(before, "time_s"));
  for (const auto* device : {"gnss", "imu", "battery", "base"})
    if (auto* node = find(status, device))
      add_sample_rate(*node, at(before, device), now_s, before_s);
  if (auto* sensors = find(status, "sensors"); sensors != nullptr && sensors->list() != nullptr)
    for (auto& sensor : std::get<std::vector<Node>>(sensors->value))
      add_sample_rate(sensor, same(at(before, "sensors"), sensor, "name"), now_s, before_s);
  if (auto* axes = find(status, "axes"); axes != nullptr && axes->list() != nullptr)
    for (auto& axis : std::get<std::vector<Node>>(axes->value))
      add_sample_rate(axis, same(at(before, "axes"), axis, "joint"), now_s, before_s);
  if (auto* links = find(status, "links"); links != nullptr && links->list() != nullptr)
    for (auto& link : std::get<std::vector<Node>>(links->value))
      add_link_rates(link, same(at(before, "links"), link, "name"), now_s - before_s);
}

std::string json_line(const Node& node) {
  json::JsonText out;
  write(out, node);
  return out.take();
}

}  // namespace drover::cli
