#include "core/paper_law.h"

#include <algorithm>
#include <array>
#include <stdexcept>
#include <string_view>

#include "core/frames.h"

namespace skein {
namespace {

struct Named {
  std::string_view name;
  double* value;
};

std::array<Named, 21> Names(PaperParameters& parameters) {
  MixerGains& mixer = parameters.mixer;
  PidGains& speed = parameters.speed;
  PidGains& course = parameters.course;
  PidGains& climb = parameters.climb;
  return {{{"k_ex", &mixer.k_ex},
           {"k_ev", &mixer.k_ev},
           {"k_ey", &mixer.k_ey},
           {"k_ephi", &mixer.k_ephi},
           {"k_ez", &mixer.k_ez},
           {"k_emu", &mixer.k_emu},
           {"saturation_forward_m", &mixer.saturation_forward_m},
           {"saturation_left_m", &mixer.saturation_left_m},
           {"saturation_up_m", &mixer.saturation_up_m},
           {"speed_p", &speed.p},
           {"speed_i", &speed.i},
           {"speed_d", &speed.d},
           {"speed_n", &speed.n},
           {"course_p", &course.p},
           {"course_i", &course.i},
           {"course_d", &course.d},
           {"course_n", &course.n},
           {"climb_p", &climb.p},
           {"climb_i", &climb.i},
           {"climb_d", &climb.d},
           {"climb_n", &climb.n}}};
}

/// Throws what Check() throws, with the loop in front of the factor's name.
void CheckLoop(const PidGains& gains, const std::string& loop) {
  try {
    Check(gains);
  } catch (const std::invalid_argument& problem) {
    throw std::invalid_argument(loop + "_" + problem.what());
  }
}

void Check(const PaperParameters& parameters) {
  Check(parameters.mixer);
  CheckLoop(parameters.speed, "speed");
  CheckLoop(parameters.course, "course");
  CheckLoop(parameters.climb, "climb");
}

/// A response that falls short of eq. (1) is at a limit.
AtLimit Compare(double response, double wanted) {
  if (response < wanted) return AtLimit::kUpper;
  if (response > wanted) return AtLimit::kLower;
  return AtLimit::kNone;
}

}  // namespace

PaperParameters PaperParametersFrom(const std::map<std::string, double>& by_name) {
  PaperParameters parameters;
  const auto names = Names(parameters);
  for (const auto& [name, value] : by_name) {
    const auto found = std::find_if(names.begin(), names.end(),
                                    [&name = name](const Named& named) { return named.name == name; });
    if (found == names.end()) {
      throw std::invalid_argument("control \"paper\" has no gain \"" + name + "\"");
    }
    *found->value = value;
  }
  Check(parameters);
  return parameters;
}

PaperLaw::PaperLaw(const PaperParameters& parameters)
    : mixer_((Check(parameters), parameters.mixer)),
      speed_(parameters.speed),
      course_(parameters.course),
      climb_(parameters.climb) {}

AutopilotInput PaperLaw::Update(const VehicleState& leader, const SlotOffset& slot, const VehicleState& uav,
                                const VehicleModel& model, double dt_s) {
  const StateError error = ErrorInLeaderFrame(leader, slot, uav);
  const MixedError mixed = Mix(error, mixer_);

  AtLimit speed_limit = AtLimit::kNone;
  AtLimit course_limit = AtLimit::kNone;
  AtLimit climb_limit = AtLimit::kNone;
  if (input_) {
    const AutopilotRates wanted = UnlimitedResponse(uav, *input_, model.gains);
    const AutopilotRates response = Respond(uav, *input_, model);
    speed_limit = Compare(response.acceleration_m_s2, wanted.acceleration_m_s2);
    course_limit = Compare(response.course_rate_rad_s, wanted.course_rate_rad_s);
    climb_limit = Compare(response.climb_rate_rad_s, wanted.climb_rate_rad_s);
  }

  input_ = {speed_.Update(mixed.speed, dt_s, speed_limit),
            UnwrapNear(leader.course_rad, uav.course_rad) + course_.Update(mixed.course, dt_s, course_limit),
            leader.climb_rad + climb_.Update(mixed.climb, dt_s, climb_limit)};
  return *input_;
}

void PaperLaw::Freeze() {
  speed_.Freeze();
  course_.Freeze();
  climb_.Freeze();
}

void PaperLaw::Reset() {
  speed_.Reset();
  course_.Reset();
  climb_.Reset();
  input_.reset();
}

}  // namespace skein
