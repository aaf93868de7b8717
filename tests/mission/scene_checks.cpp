// scene_checks FOLDER...: judges the runs that tests/mission/scenes left, and says what is wrong,
// with each of them ("FAILED 12: ...", by the folder's name) and with all of them together ("FAILED
// series: ...": too little happened to prove anything). Exit status: 0 all is well; 1 something is
// not; 2 a record cannot be read.
#include <cstdio>
#include <exception>
#include <fstream>

#include "mission/conduct.h"
#include "mission/scene_series.h"

namespace {

using drover::mission::Appeared;

nlohmann::json played(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "scenario.json");
  return nlohmann::json::parse(stream);
}

}  // namespace

int main(int argc, char** argv) {
  drover::mission::SeriesProof proof;
  std::size_t bad = 0;
  bool unreadable = false;
  double least_gap_m = 1e9;
  for (int i = 1; i < argc; ++i) {
    const std::filesystem::path folder = argv[i];
    try {
      const auto record = drover::mission::read_record(folder, played(folder));
      auto report = drover::mission::judge_series(record);
      for (auto& problem : check_frames(record)) report.problems.push_back(std::move(problem));
      for (auto& problem : check_motion(record)) report.problems.push_back(std::move(problem));
      // What is not driven proves nothing.
      if (10 * report.accepted < 9 * report.drives)
        report.problems.push_back("only " + std::to_string(report.accepted) + " of " +
                                  std::to_string(report.drives) + " starts were accepted");
      using Where = Appeared::Where;
      std::printf(
          "%s: %zu drives, things: %zu far, %zu between, %zu near, %zu grazing, %zu beside, "
          "%zu at rest; nearest %.3f m; %zu contacts with what came too near\n",
          folder.filename().c_str(), report.drives, report.count(Where::far),
          report.count(Where::between), report.count(Where::near), report.count(Where::grazing),
          report.count(Where::beside), report.count(Where::at_rest),
          std::min(report.least_gap_m, 99.0), report.excused_contacts);
      for (const auto& one : report.appeared)
        if (one.stood_m >= 0) std::printf("  stood before it: %.4f m\n", one.stood_m);
      for (const auto& problem : report.problems)
        std::printf("FAILED %s: %s\n", folder.filename().c_str(), problem.c_str());
      proof.add(report);
      bad += report.problems.size();
      least_gap_m = std::min(least_gap_m, report.least_gap_m);
    } catch (const std::exception& error) {
      std::printf("FAILED %s: %s\n", folder.filename().c_str(), error.what());
      unreadable = true;
    }
  }
  for (const auto& lack : proof.lacks()) {
    std::printf("FAILED series: %s\n", lack.c_str());
    ++bad;
  }
  std::printf(
      "%zu scenes, %zu problems; nearest while moving %.3f m; stood before %zu of %zu far "
      "things, %zu came too near\n",
      proof.drives, bad, std::min(least_gap_m, 99.0), proof.stood, proof.far, proof.near);
  if (unreadable) return 2;
  return bad == 0 && proof.drives > 0 ? 0 : 1;
}
