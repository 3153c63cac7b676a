#pragma once

#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "bus/executor.h"

namespace skein::recorder {

/// "NAME.lcm" for part 0, then "NAME.lcm.01", "NAME.lcm.02", ... "NAME.lcm.100". @param recording "NAME.lcm".
std::string PartName(const std::string& recording, int part);

/// A scenario's name as the beginning of a file name: lower case, with nothing in it that a shell minds;
/// "flight" when nothing is left of it.
std::string FileStem(const std::string& scenario);

/// What the card of a recording says: NAME.lcm.json, beside its parts. Nothing is ever removed that is not on
/// such a card (recording_folder.h).
struct Card {
  struct Part {
    std::string file;    ///< as PartName
    std::string begins;  ///< the first bytes in hexadecimal; they hold a time in microseconds, so tell one
                         ///< file from any other
  };
  std::string scenario;  ///< as FLEET_ROSTER has it, "" when none was heard
  bus::Utime start_utime = 0;
  std::string lcm_url;
  std::vector<Part> parts;
};

/// The first bytes of a file as a card has them; "" when it has not so many yet, or cannot be read.
std::string BeginOf(const std::filesystem::path& file);

/// A recording that is being written: its name, its parts and its card. lcm-logger is the one who writes the
/// parts; it is told of one path alone, `way_in()`, a symbolic link that leads to the part of the moment.
///
/// The card is locked (flock) for as long as this lives, which tells others that the recording is not over,
/// also when this process is killed.
class Recording {
 public:
  /// Claims a name of its own in the folder, which is made if need be. Nothing is to be recorded until
  /// NextPart().
  /// @param stem FileStem of the scenario. @param link the symbolic link to make.
  /// Throws std::system_error, or std::filesystem::filesystem_error.
  Recording(std::filesystem::path folder, const std::string& stem, Card card, std::filesystem::path link);
  ~Recording();
  Recording(const Recording&) = delete;
  Recording& operator=(const Recording&) = delete;

  const std::string& name() const { return name_; }
  const std::string& stem() const { return stem_; }
  const Card& card() const { return card_; }
  const std::filesystem::path& way_in() const { return link_; }

  /// File name of the part of the moment, "" before the first.
  std::string part() const { return parts_ == 0 ? "" : PartName(name_, parts_ - 1); }
  int parts() const { return parts_; }
  /// Size of all parts, as of the last Look() [B].
  std::int64_t bytes() const { return bytes_before_ + part_bytes_; }
  std::int64_t part_bytes() const { return part_bytes_; }

  /// From now on the link leads to a part that does not exist yet; the same one again when nothing was
  /// written into it. Throws as the constructor.
  void NextPart();

  /// Looks how long the part of the moment has become; 0 when it is not there (any more). Its first bytes go
  /// onto the card.
  void Look();

  /// Gives the recording another name, also while lcm-logger writes it. Throws as the constructor.
  void Rename(const std::string& stem, const std::string& scenario);

 private:
  void Claim();
  void Point() const;
  void WriteCard();

  std::filesystem::path folder_;
  std::string stem_;
  std::string name_;
  Card card_;
  std::filesystem::path link_;
  int parts_ = 0;
  std::int64_t bytes_before_ = 0;  ///< of the parts before this one
  std::int64_t part_bytes_ = 0;
  bool on_card_ = false;  ///< the part of the moment
  int card_fd_ = -1;      ///< holds the lock
};

}  // namespace skein::recorder
