#include "cli/zone_import.h"

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <ostream>

#include "cli/exit_codes.h"
#include "cli/layout.h"
#include "cli/reply.h"
#include "cli/show_zones.h"
#include "cli/zone_preview.h"
#include "json/json_text.h"
#include "scene/zone/import_zone.h"

namespace drover::cli {

namespace {

using json::JsonText;

/// Larger texts take droverd a while.
constexpr std::size_t kLong_bytes = 256 * 1024;

int refuse(const ImportOrder& order, const std::string& reason, std::ostream& out,
           std::ostream& err) {
  if (order.json) {
    out << JsonText().open('{').key("ok").boolean(false).key("reason").text(reason).close('}').str()
        << '\n';
  } else {
    err << "refused: " << reason << '\n';
  }
  return kRefused;
}

/// Empty, or why not.
std::string read_zone_file(const std::string& path, std::string& text) {
  errno = 0;
  std::ifstream in(path, std::ios::binary);
  if (!in) return std::strerror(errno);
  if (std::filesystem::is_directory(path)) return std::strerror(EISDIR);
  text.resize(scene::kMaxImportBytes + 1);
  in.read(text.data(), static_cast<std::streamsize>(text.size()));
  if (in.bad()) return "cannot be read";
  text.resize(static_cast<std::size_t>(in.gcount()));
  if (text.size() > scene::kMaxImportBytes) return "is larger than 2 MiB, which is no fence";
  return "";
}

std::string import_request(const ImportOrder& order, const scene::ZoneOrder& zone,
                           const std::string& text) {
  JsonText out;
  out.reserve(text.size() + text.size() / 4);
  // droverd takes a long line only when it begins so.
  out.open('{').key("cmd").text("zone_import").key("name").text(zone.name);
  out.key("kind").text(order.keep_in ? "keep_in" : "keep_out");
  out.key("source").text(zone.source).key("text").text(text).close('}');
  return out.take();
}

/// Null: there is none of that name.
const json::Node* zone_of(const Reply& zones, const std::string& name) {
  const auto* list = at(zones.document.root, "zones").list();
  if (list == nullptr) return nullptr;
  for (const json::Node& zone : *list)
    if (text(at(zone, "name")) == name) return &zone;
  return nullptr;
}

}  // namespace

int import_zone_file(const ImportOrder& order, const ImportTalk& talk, std::ostream& out,
                     std::ostream& err) {
  std::string text;
  if (const auto why = read_zone_file(order.file, text); !why.empty())
    return refuse(order, order.file + ": " + why, out, err);
  scene::ZoneOrder zone_order{
      order.name, order.keep_in ? scene::Zone::Kind::keep_in : scene::Zone::Kind::keep_out,
      std::filesystem::path(order.file).filename().string(), std::nullopt};
  const auto zone = scene::import_zone(text, zone_order);
  if (!zone) return refuse(order, order.file + ": " + zone.error().text(), out, err);
  if (!order.yes) {
    // What would be refused anyway nobody has to look at.
    const auto zones = read_reply(talk.ask(request("zone_list")));
    if (!zones.done) return refuse(order, zones.reason, out, err);
    const auto status = read_reply(talk.ask(request("status")));
    const auto from = whereabouts_of(at(status.document.root, "status"));
    if (!order.json)
      out << preview_text(*zone, from, zone_of(zones, zone->zone.name)) << std::flush;
    const auto said = order.json ? std::nullopt : talk.ask_person("import it? yes or no: ");
    if (!said)
      return refuse(order,
                    "nobody was asked whether the zone is in the right place: run this on a "
                    "terminal, or say --yes when somebody has looked",
                    out, err);
    if (*said != "yes") return refuse(order, "not imported: the answer was not yes", out, err);
  }
  if (text.size() > kLong_bytes && !order.json)
    err << "droverd reads and stores " << text.size() / 1024 << " KiB ...\n" << std::flush;
  const auto answer = read_reply(talk.ask(import_request(order, zone_order, text)));
  if (order.json) out << answer.text << '\n';
  if (!answer.done) return order.json ? kRefused : refuse(order, answer.reason, out, err);
  if (!order.json) out << show_imported(answer.document.root);
  return kDone;
}

}  // namespace drover::cli
