#pragma once

#include <chrono>
#include <functional>
#include <map>
#include <optional>
#include <string>

#include "bridge/json_messages.h"
#include "bus/command_inbox.h"

namespace skein::bridge {

/// How somebody at the page introduces himself.
struct Introduction {
  std::string name{};       ///< "": the desk finds one
  std::string token{};      ///< that the same tab had before or made up, "" when there is none
  std::string page{};       ///< made up by the page each time it is loaded
  bool take = true;         ///< control, when it is free
  bool may_operate = true;  ///< else he may only look
};

/// What somebody asks of the desk.
struct ControlRequest {
  enum class Action { kTake, kAsk, kWithdraw, kGive, kRefuse, kRelease, kRename };
  Action action = Action::kTake;
  int person = 0;      ///< to whom it is given, or whose request is refused
  std::string name{};  ///< the new one
};

/// What is kept of the holder beyond the end of this process.
struct KeptHolder {
  std::string name;
  std::string token_sha256;

  bool operator==(const KeptHolder&) const = default;
};

/// Who of the people at the pages holds control: one at a time, the others look on. Control is
///
///   free --take--> held --release, or gone for kGrace--> free, or held by the first who has asked
///   held --give, or taken over by somebody who has asked and had no answer for kPatience--> held by another
///
/// A holder whose connection has dropped is known by his token when he comes back. A duplicated tab has the
/// token of the first one, which is still there, and becomes somebody else.
class ControlDesk {
 public:
  using Time = std::chrono::steady_clock::time_point;
  /// Told whenever control changes hands, with code and text of an EVENT.
  using Tell = std::function<void(const std::string& code, const std::string& text)>;

  static constexpr std::chrono::seconds kGrace{10};
  static constexpr std::chrono::seconds kPatience{15};
  static constexpr std::size_t kLongestName = 40;  ///< characters
  /// A token of a browser's own making counts from this length on: nobody guesses it.
  static constexpr std::size_t kLeastTokenSize = 32;

  explicit ControlDesk(Tell tell) : tell_(std::move(tell)) {}

  /// Before anybody enters: this one held control when the bridge died, and is waited for like a holder whose
  /// connection has dropped.
  void WaitFor(const KeptHolder& holder, Time now);
  /// Who holds control; none: nobody.
  std::optional<KeptHolder> Holder() const;

  /// Returns his number, 1 or more. It may be one who is known, and even still there: then the other
  /// connection is a dead one of the same page.
  int Enter(const Introduction& introduction, Time now);
  /// The connection has ended.
  void Leave(int person, Time now);

  bus::Answer Ask(int person, const ControlRequest& request, Time now);

  /// What the passing of time has changed. True when there is something.
  bool Look(Time now);

  /// Why somebody may not command now, "" when he may.
  std::string WhyNot(int person) const;

  /// Who is there with this token; 0: nobody.
  int Who(const std::string& token) const;

  /// The message "control" for one of them; 0: for somebody who has not introduced himself.
  Json View(int person, Time now) const;

 private:
  struct Person {
    std::string name;
    std::string token;
    std::string page;
    bool may_operate = true;
    std::optional<Time> dropped;  ///< since when his connection is gone
    std::optional<Time> asked;    ///< since when he asks for control
    std::string token_sha256{};   ///< of one from before the bridge was started, whose token is not known

    bool Has(const std::string& other_token) const;
  };

  bus::Answer Take(int person, Time now);
  bus::Answer Give(int person, int to, Time now);
  bus::Answer Refuse(int person, int whom);
  bus::Answer Rename(int person, const std::string& name);
  void Hold(int person, Time now);
  void SetFree(Time now);
  std::string NameOf(int person) const;
  std::string UniqueName(const std::string& wanted, int of) const;

  Tell tell_;
  std::map<int, Person> people_;
  int last_number_ = 0;
  int holder_ = 0;  ///< 0: nobody
};

/// What is wrong with a name, "" when nothing is. White space around it must be gone.
std::string NameProblem(const std::string& name);

}  // namespace skein::bridge
