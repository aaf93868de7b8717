#include "cli/show_replay.h"

#include <cstdio>

#include "json/json_text.h"

namespace drover::cli {

namespace {

using gateway::Replayed;

constexpr const char* word(Replayed::Verdict verdict) {
  switch (verdict) {
    case Replayed::Verdict::equal: return "equal";
    case Replayed::Verdict::differs: return "differs";
    case Replayed::Verdict::unusable: return "unusable";
  }
  return "unusable";
}

double seconds(const Replayed& it) {
  return it.begin == kNever ? 0 : to_s(it.end - it.begin);
}

template <class... Values>
std::string formatted(const char* pattern, Values... values) {
  char text[200] = {};
  std::snprintf(text, sizeof text, pattern, values...);
  return text;
}

constexpr auto kOtherMathematics =
    "sin, exp and the others have other last bits here than where it was recorded. That alone may\n"
    "make a difference; if it was recorded in the lab, or on a CPU without FMA, try again with\n"
    "  GLIBC_TUNABLES=glibc.cpu.hwcaps=-FMA,-FMA4,-AVX2\n";

/// What a program reads of every verb that has not done what was asked.
std::string reason(const Replayed& it) {
  if (it.verdict == Replayed::Verdict::unusable) return it.note;
  return formatted("differs in cycle %llu: ",
                   static_cast<unsigned long long>(it.difference.cycle)) +
         it.difference.what;
}

std::string show_difference(const Replayed& it) {
  const auto& d = it.difference;
  std::string out =
      formatted("differs in cycle %llu, %.3f s after its begin (at %.9f s): ",
                static_cast<unsigned long long>(d.cycle), to_s(d.time - it.begin), to_s(d.time)) +
      d.what + "\n  recorded  " + d.recorded + "\n  replayed  " + d.replayed + "\n";
  if (d.more > 0) out += formatted("  and %zu more in that cycle\n", d.more);
  out += "the last inputs before it:\n";
  for (const auto& input : d.inputs) out += "  " + input + "\n";
  return out + (it.other_mathematics ? kOtherMathematics : "");
}

}  // namespace

std::string replay_json(const Replayed& it) {
  json::JsonText out;
  const bool equal = it.verdict == Replayed::Verdict::equal;
  out.open('{').key("ok").boolean(equal);
  if (!equal) out.key("reason").text(reason(it));
  out.key("verdict").text(word(it.verdict)).key("note").text(it.note);
  out.key("recorded_by").text(it.version).key("seconds").number(seconds(it));
  out.key("inputs").integer(static_cast<std::int64_t>(it.inputs));
  out.key("cycles").integer(static_cast<std::int64_t>(it.cycles));
  out.key("other_mathematics").boolean(it.other_mathematics);
  out.key("not_compared").open('[');
  for (const auto& name : it.not_compared) out.text(name);
  out.close(']');
  if (it.verdict == Replayed::Verdict::differs) {
    const auto& d = it.difference;
    out.key("difference").open('{').key("what").text(d.what);
    out.key("cycle").integer(static_cast<std::int64_t>(d.cycle));
    out.key("time_s").number(to_s(d.time)).key("since_begin_s").number(to_s(d.time - it.begin));
    out.key("recorded").text(d.recorded).key("replayed").text(d.replayed);
    out.key("more").integer(static_cast<std::int64_t>(d.more)).key("inputs_before").open('[');
    for (const auto& input : d.inputs) out.text(input);
    out.close(']').close('}');
  }
  return out.close('}').take();
}

std::string show_replay(const Replayed& it) {
  std::string out = it.verdict == Replayed::Verdict::differs
                        ? show_difference(it)
                        : formatted("equal: %llu cycles, %llu inputs, %.1f s\n",
                                    static_cast<unsigned long long>(it.cycles),
                                    static_cast<unsigned long long>(it.inputs), seconds(it));
  if (!it.note.empty()) out += it.note + "\n";
  if (!it.not_compared.empty())
    out += formatted("%zu values were not compared, another version recorded: ",
                     it.not_compared.size()) +
           it.not_compared.front() + (it.not_compared.size() > 1 ? ", ...\n" : "\n");
  return out;
}

}  // namespace drover::cli
