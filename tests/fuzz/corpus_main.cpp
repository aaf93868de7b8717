// Runs a fuzz target without libFuzzer: each file of the named folders, and seeded mutations of it.
//
//   <target> MUTATIONS FOLDER...
#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <random>
#include <vector>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

namespace {

using Bytes = std::vector<std::uint8_t>;

Bytes read(const std::filesystem::path& path) {
  std::ifstream stream(path, std::ios::binary);
  return Bytes(std::istreambuf_iterator<char>(stream), {});
}

// One to eight small damages: a changed byte, a cut, a repeated part, a part of another input.
Bytes mutated(Bytes bytes, const std::vector<Bytes>& corpus, std::mt19937_64& random) {
  const auto below = [&](std::size_t n) -> std::size_t { return n == 0 ? 0 : random() % n; };
  const auto offset = [](std::size_t n) { return static_cast<std::ptrdiff_t>(n); };
  for (std::size_t left = 1 + below(8); left > 0; --left) {
    const std::size_t at = below(bytes.size());
    const std::size_t length = below(std::min<std::size_t>(bytes.size() - at, 64) + 1);
    const Bytes& donor = random() % 2 == 0 ? bytes : corpus[below(corpus.size())];
    const std::size_t from = below(donor.size());
    const std::size_t count = below(std::min<std::size_t>(donor.size() - from, 200) + 1);
    const Bytes part(donor.begin() + offset(from), donor.begin() + offset(from + count));
    switch (random() % 4) {
      case 0:
        if (!bytes.empty()) bytes[at] = static_cast<std::uint8_t>(random());
        break;
      case 1:
        if (!bytes.empty()) bytes[at] ^= static_cast<std::uint8_t>(1U << below(8));
        break;
      case 2: bytes.erase(bytes.begin() + offset(at), bytes.begin() + offset(at + length)); break;
      default: bytes.insert(bytes.begin() + offset(at), part.begin(), part.end()); break;
    }
  }
  return bytes;
}

}  // namespace

int main(int argc, char** argv) {
  if (argc < 3) {
    std::fprintf(stderr, "usage: %s MUTATIONS FOLDER...\n", argv[0]);
    return 2;
  }
  const long mutations = std::strtol(argv[1], nullptr, 10);
  std::vector<std::filesystem::path> paths;
  for (int i = 2; i < argc; ++i)
    for (const auto& each : std::filesystem::directory_iterator(argv[i])) paths.push_back(each);
  std::sort(paths.begin(), paths.end());
  std::vector<Bytes> corpus;
  for (const auto& path : paths) {
    corpus.push_back(read(path));
    LLVMFuzzerTestOneInput(corpus.back().data(), corpus.back().size());
  }
  if (corpus.empty()) {
    std::fprintf(stderr, "no inputs\n");
    return 1;
  }
  std::mt19937_64 random(1);
  for (long i = 0; i < mutations; ++i) {
    const Bytes input = mutated(corpus[random() % corpus.size()], corpus, random);
    LLVMFuzzerTestOneInput(input.data(), input.size());
  }
  std::printf("%zu inputs, %ld mutations\n", corpus.size(), mutations);
  return 0;
}
