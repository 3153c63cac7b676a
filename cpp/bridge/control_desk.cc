#include "bridge/control_desk.h"

#include <spdlog/fmt/fmt.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

#include "access/tokens.h"

namespace skein::bridge {
namespace {

using bus::Answer;

constexpr const char* kOnlyTheHolder = "only who holds control can do that";

std::string NewToken() {
  std::random_device random;
  return fmt::format("{:08x}{:08x}{:08x}{:08x}", random(), random(), random(), random());
}

double Seconds(ControlDesk::Time::duration duration) {
  return std::chrono::duration<double>(duration).count();
}

/// For how long it is to wait still, 0 when it is over.
double Left(ControlDesk::Time since, std::chrono::seconds whole, ControlDesk::Time now) {
  return std::max(0.0, Seconds(whole - (now - since)));
}

}  // namespace

std::string NameProblem(const std::string& name) {
  // The bytes that begin a character of UTF-8.
  const auto characters = std::ranges::count_if(name, [](unsigned char c) { return (c & 0xC0) != 0x80; });
  if (name.empty() || static_cast<std::size_t>(characters) > ControlDesk::kLongestName) {
    return fmt::format("a name has 1 to {} characters", ControlDesk::kLongestName);
  }
  if (std::ranges::any_of(name, [](unsigned char c) { return c < 0x20 || c == 0x7F; })) {
    return "a name has no control characters";
  }
  if (name.front() == ' ' || name.back() == ' ') return "a name neither begins nor ends with a blank";
  return "";
}

bool ControlDesk::Person::Has(const std::string& other_token) const {
  if (other_token.empty()) return false;
  return token.empty() ? token_sha256 == access::Sha256(other_token) : token == other_token;
}

void ControlDesk::WaitFor(const KeptHolder& holder, Time now) {
  holder_ = ++last_number_;
  Person& person = people_[holder_];
  person.name = holder.name;
  person.token_sha256 = holder.token_sha256;
  person.dropped = now;
}

std::optional<KeptHolder> ControlDesk::Holder() const {
  const auto holder = people_.find(holder_);
  if (holder == people_.end()) return std::nullopt;
  const Person& person = holder->second;
  return KeptHolder{person.name, person.token.empty() ? person.token_sha256 : access::Sha256(person.token)};
}

int ControlDesk::Enter(const Introduction& introduction, Time now) {
  const auto known =
      std::ranges::find_if(people_, [&](const auto& entry) { return entry.second.Has(introduction.token); });
  int number = 0;
  const bool same =
      known != people_.end() &&
      (known->second.dropped || (!introduction.page.empty() && known->second.page == introduction.page));
  if (same) {
    number = known->first;
    known->second.dropped.reset();
    known->second.token = introduction.token;
    known->second.page = introduction.page;
    known->second.may_operate = introduction.may_operate;
    if (!introduction.name.empty()) known->second.name = UniqueName(introduction.name, number);
    // His token has become a viewer's meanwhile.
    if (number == holder_ && !introduction.may_operate) SetFree(now);
  } else {
    number = ++last_number_;
    people_[number] = {
        UniqueName(introduction.name, number),
        // One that the tab made up itself is known even if it is reloaded before any answer has come.
        known == people_.end() && introduction.token.size() >= kLeastTokenSize ? introduction.token
                                                                               : NewToken(),
        introduction.page,
        introduction.may_operate,
        std::nullopt,
        std::nullopt,
        {}};
  }
  if (introduction.take && holder_ == 0 && introduction.may_operate) Take(number, now);
  return number;
}

void ControlDesk::Leave(int person, Time now) {
  const auto left = people_.find(person);
  if (left == people_.end()) return;
  if (person == holder_) {
    left->second.dropped = now;
  } else {
    people_.erase(left);
  }
}

Answer ControlDesk::Ask(int person, const ControlRequest& request, Time now) {
  Person& asking = people_.at(person);
  switch (request.action) {
    case ControlRequest::Action::kTake:
      return Take(person, now);
    case ControlRequest::Action::kAsk:
      if (!asking.may_operate) return Answer::Refused("this session may only look");
      if (holder_ == 0 || holder_ == person) return Take(person, now);
      if (!asking.asked) asking.asked = now;
      return Answer::Accepted();
    case ControlRequest::Action::kWithdraw:
      asking.asked.reset();
      return Answer::Accepted();
    case ControlRequest::Action::kGive:
      return Give(person, request.person, now);
    case ControlRequest::Action::kRefuse:
      return Refuse(person, request.person);
    case ControlRequest::Action::kRename:
      return Rename(person, request.name);
    case ControlRequest::Action::kRelease:
      break;
  }
  if (person != holder_) return Answer::Refused(kOnlyTheHolder);
  tell_("control_released", NameOf(person) + " has released control");
  SetFree(now);
  return Answer::Accepted();
}

Answer ControlDesk::Take(int person, Time now) {
  const Person& taking = people_.at(person);
  if (!taking.may_operate) return Answer::Refused("this session may only look");
  if (person == holder_) return Answer::Accepted();
  if (holder_ == 0) {
    tell_("control_taken", NameOf(person) + " has taken control");
  } else {
    if (!taking.asked) return Answer::Refused(NameOf(holder_) + " holds control: ask for it");
    if (const double left_s = Left(*taking.asked, kPatience, now); left_s > 0) {
      return Answer::Refused(
          fmt::format("{} has {:.0f} s left to answer", NameOf(holder_), std::ceil(left_s)));
    }
    tell_("control_taken_over",
          fmt::format("{} has taken over control from {}, who had not answered for {} s", NameOf(person),
                      NameOf(holder_), kPatience.count()));
  }
  Hold(person, now);
  return Answer::Accepted();
}

Answer ControlDesk::Give(int person, int to, Time now) {
  if (person != holder_) return Answer::Refused(kOnlyTheHolder);
  const auto receiver = people_.find(to);
  if (receiver == people_.end() || to == person)
    return Answer::Refused("there is nobody else of that number");
  if (!receiver->second.may_operate) return Answer::Refused(NameOf(to) + " may only look");
  tell_("control_given", NameOf(person) + " has handed control over to " + NameOf(to));
  Hold(to, now);
  return Answer::Accepted();
}

Answer ControlDesk::Refuse(int person, int whom) {
  if (person != holder_) return Answer::Refused(kOnlyTheHolder);
  const auto asking = people_.find(whom);
  if (asking == people_.end() || !asking->second.asked) return Answer::Refused("nobody of that number asks");
  asking->second.asked.reset();
  return Answer::Accepted();
}

Answer ControlDesk::Rename(int person, const std::string& name) {
  const std::string problem = NameProblem(name);
  if (!problem.empty()) return Answer::Refused(problem);
  people_.at(person).name = UniqueName(name, person);
  return Answer::Accepted();
}

void ControlDesk::Hold(int person, Time now) {
  const int before = std::exchange(holder_, person);
  people_.at(person).asked.reset();
  for (auto& [number, one] : people_) {
    if (one.asked) one.asked = now;  // the new holder has all his time to answer
  }
  // One whose connection is gone was kept for the sake of control only.
  const auto former = people_.find(before);
  if (former != people_.end() && former->second.dropped) people_.erase(former);
}

void ControlDesk::SetFree(Time now) {
  const int before = std::exchange(holder_, 0);
  const auto former = people_.find(before);
  if (former != people_.end() && former->second.dropped) people_.erase(former);
  const auto first = std::ranges::min_element(
      people_, {}, [](const auto& entry) { return entry.second.asked.value_or(Time::max()); });
  if (first == people_.end() || !first->second.asked) return;
  tell_("control_taken", NameOf(first->first) + ", who had asked for it, has control");
  Hold(first->first, now);
}

bool ControlDesk::Look(Time now) {
  const auto holder = people_.find(holder_);
  if (holder == people_.end() || !holder->second.dropped || now - *holder->second.dropped < kGrace)
    return false;
  tell_("control_lost",
        fmt::format("{} has been gone for {} s: control is free", NameOf(holder_), kGrace.count()));
  SetFree(now);
  return true;
}

std::string ControlDesk::WhyNot(int person) const {
  if (holder_ == person && person != 0) return "";
  return holder_ == 0 ? "nobody holds control: take it first" : NameOf(holder_) + " holds control";
}

int ControlDesk::Who(const std::string& token) const {
  const auto found = std::ranges::find_if(people_, [&](const auto& entry) {
    return !token.empty() && entry.second.token == token && !entry.second.dropped;
  });
  return found == people_.end() ? 0 : found->first;
}

Json ControlDesk::View(int person, Time now) const {
  Json view = {{"type", "control"}, {"you", person}, {"holder", holder_}, {"people", Json::array()}};
  const auto you = people_.find(person);
  view["token"] = you == people_.end() ? "" : you->second.token;
  view["may_operate"] = you != people_.end() && you->second.may_operate;
  for (const auto& [number, one] : people_) {
    view["people"].push_back({{"id", number},
                              {"name", one.name},
                              {"may_operate", one.may_operate},
                              // Null while they are there, or do not ask.
                              {"kept_for_s", one.dropped ? Json(Left(*one.dropped, kGrace, now)) : Json()},
                              {"waits_for_s", one.asked ? Json(Left(*one.asked, kPatience, now)) : Json()}});
  }
  return view;
}

std::string ControlDesk::NameOf(int person) const {
  const auto found = people_.find(person);
  return found == people_.end() ? "" : found->second.name;
}

std::string ControlDesk::UniqueName(const std::string& wanted, int of) const {
  const auto taken = [&](const std::string& name) {
    return std::ranges::any_of(
        people_, [&](const auto& entry) { return entry.first != of && entry.second.name == name; });
  };
  if (!wanted.empty() && !taken(wanted)) return wanted;
  for (int number = wanted.empty() ? 1 : 2;; ++number) {
    const std::string name =
        wanted.empty() ? fmt::format("Operator {}", number) : fmt::format("{} ({})", wanted, number);
    if (!taken(name)) return name;
  }
}

}  // namespace skein::bridge
