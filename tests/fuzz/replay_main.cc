// Gives a target files, one after the other: what is known must stay so. Without libFuzzer.
//
//   NAME_replay FILE|FOLDER...
#include <iterator>
#include <vector>

#include "fuzz_target.h"

int main(int argc, char** argv) {
  namespace fs = std::filesystem;
  int count = 0;
  const auto replay = [&](const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    const std::vector<char> bytes{std::istreambuf_iterator<char>(stream), {}};
    std::cout << file.string() << std::endl;  // before it crashes
    LLVMFuzzerTestOneInput(reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
    ++count;
  };
  for (int i = 1; i < argc; ++i) {
    if (fs::is_directory(argv[i])) {
      for (const auto& entry : fs::directory_iterator(argv[i])) replay(entry.path());
    } else if (fs::exists(argv[i])) {
      replay(argv[i]);
    }
  }
  std::cout << count << " inputs\n";
  return count > 0 ? 0 : 1;
}
