#include "controller/state_file.h"

#include <bit>
#include <cstring>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <string>

#include "bus/decode.h"
#include "bus/validate.h"

namespace skein::controller {
namespace {

constexpr char kMagic[] = "skein-controller-state-2\n";

void Append(std::string& bytes, std::int64_t number) {
  bytes.append(reinterpret_cast<const char*>(&number), sizeof number);
}

template <typename Message>
void Append(std::string& bytes, const Message& message) {
  const int size = message.getEncodedSize();
  Append(bytes, static_cast<std::int64_t>(size));
  const std::size_t start = bytes.size();
  bytes.resize(start + static_cast<std::size_t>(size));
  message.encode(bytes.data() + start, 0, size);
}

/// Takes numbers and messages off the front of the bytes; none when they do not hold one.
class Reader {
 public:
  explicit Reader(std::string_view bytes) : rest_(bytes) {}

  std::optional<std::int64_t> Number() {
    std::int64_t number = 0;
    if (rest_.size() < sizeof number) return std::nullopt;
    std::memcpy(&number, rest_.data(), sizeof number);
    rest_.remove_prefix(sizeof number);
    return number;
  }

  template <typename Message>
  std::optional<Message> Take() {
    const auto size = Number();
    if (!size || *size < 0 || static_cast<std::size_t>(*size) > rest_.size()) return std::nullopt;
    auto message = bus::Decode<Message>(rest_.data(), static_cast<std::size_t>(*size));
    rest_.remove_prefix(static_cast<std::size_t>(*size));
    if (message && !bus::Valid(*message)) return std::nullopt;
    return message;
  }

 private:
  std::string_view rest_;
};

}  // namespace

void WriteState(const std::filesystem::path& file, const ControllerState& state) {
  std::string bytes = kMagic;
  Append(bytes, static_cast<std::int64_t>(state.start_utime));
  Append(bytes, static_cast<std::int64_t>(state.formations.size()));
  for (const FormationState& formation : state.formations) {
    Append(bytes, formation.formation);
    Append(bytes, formation.path);
    Append(bytes, formation.status);
    Append(bytes, static_cast<std::int64_t>(formation.path_before_hold.has_value()));
    if (formation.path_before_hold) {
      Append(bytes, *formation.path_before_hold);
      Append(bytes, std::bit_cast<std::int64_t>(formation.arc_before_hold_m));
    }
  }
  const std::filesystem::path temporary = file.string() + ".new";
  std::ofstream stream(temporary, std::ios::binary | std::ios::trunc);
  stream.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
  stream.close();
  if (!stream) throw std::runtime_error(temporary.string() + ": cannot be written");
  std::filesystem::rename(temporary, file);
}

std::optional<ControllerState> ReadState(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  const std::string bytes{std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
  if (!bytes.starts_with(kMagic)) return std::nullopt;
  Reader reader(std::string_view(bytes).substr(sizeof kMagic - 1));
  const auto start_utime = reader.Number();
  const auto count = reader.Number();
  if (!start_utime || !count) return std::nullopt;
  ControllerState state;
  state.start_utime = *start_utime;
  for (std::int64_t i = 0; i < *count; ++i) {
    auto formation = reader.Take<formation_t>();
    auto path = reader.Take<path_t>();
    auto status = reader.Take<formation_status_t>();
    const auto holds = reader.Number();
    if (!formation || !path || !status || !holds) return std::nullopt;
    FormationState saved{std::move(*formation), std::move(*path), std::move(*status), std::nullopt, 0};
    if (*holds != 0) {
      saved.path_before_hold = reader.Take<path_t>();
      const auto arc = reader.Number();
      if (!saved.path_before_hold || !arc) return std::nullopt;
      saved.arc_before_hold_m = std::bit_cast<double>(*arc);
    }
    state.formations.push_back(std::move(saved));
  }
  return state;
}

}  // namespace skein::controller
