// What is in a recording: skein log info, events, csv; cutting and comparing recordings.

#include <CLI/CLI.hpp>
#include <lcm/lcm-cpp.hpp>
#include <limits>
#include <set>

#include "cli/log/text.h"
#include "unit/cli/log_fixture.h"
#include "unit/recording/log_maker.h"

namespace skein::cli {
namespace {

using recording::EventBytes;

const std::vector<std::vector<std::string>> kEveryCommand = {{"info"},
                                                             {"events"},
                                                             {"csv", "--channel", "FLEET_STATE"},
                                                             {"geojson"},
                                                             {"kml"},
                                                             {"plot"},
                                                             {"plot", "--figure", "6"}};

std::vector<std::string> With(std::vector<std::string> command, const std::string& file) {
  command.insert(command.begin() + 1, file);
  return command;
}

TEST_F(LogTest, TellsWhatIsInARecording) {
  const auto info = Json({"info", flight(), "--json"});
  EXPECT_EQ(info["bytes"], std::filesystem::file_size(flight()));
  EXPECT_NEAR(info["duration_s"], 40, 1);
  EXPECT_EQ(info["start"].get<std::string>().substr(0, 13), "2020-01-01T00");
  ASSERT_EQ(info["flights"].size(), 1U);
  EXPECT_EQ(info["flights"][0]["scenario"], "Three with a drop");
  EXPECT_EQ(info["flights"][0]["vehicles"][2]["callsign"], "UAV3");
  for (const auto& channel : info["channels"]) {
    EXPECT_TRUE(channel["known"]) << channel;
    EXPECT_EQ(channel["undecodable"], 0) << channel;
    if (channel["name"] == "FLEET_STATE") {
      EXPECT_EQ(channel["type"], "fleet_state_t");
      EXPECT_EQ(channel["count"], 801);
      EXPECT_NEAR(channel["rate_hz"], 20, 0.01);
    }
  }
  EXPECT_GE(info["events"]["warning"], 1);
  EXPECT_GE(info["alarm_count"], 1);
  EXPECT_TRUE(info["damage"].empty());
  const std::string text = Output({"info", flight()});
  EXPECT_NE(text.find("scenario  Three with a drop, 3 UAVs: UAV1, UAV2, UAV3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("damage    none\n"), std::string::npos) << text;
}

TEST_F(LogTest, KeepsOtherPeoplesChannelsAndListsThemAsUnknown) {
  const std::string file =
      Write("foreign.lcm", Read(flight()) + EventBytes(1, 1, "POSE\x1b[2J", "12345678abc") +
                               EventBytes(2, 1, "POSE\x1b[2J", ""));
  const auto info = Json({"info", file, "--json"});
  bool is_listed = false;
  for (const auto& channel : info["channels"]) {
    if (channel["name"] != "POSE?[2J") continue;
    is_listed = true;
    EXPECT_FALSE(channel["known"]);
    EXPECT_EQ(channel["count"], 2);
    EXPECT_EQ(channel["bytes"], 11);
  }
  EXPECT_TRUE(is_listed);
  EXPECT_NE(Output({"info", file}).find("POSE?[2J          unknown"), std::string::npos)
      << Output({"info", file});
}

TEST_F(LogTest, CountsWhatDoesNotDecode) {
  const std::string bytes = Read(flight());
  const std::size_t at = bytes.find("FLEET_STATE") + 11;
  const std::string bad =
      EventBytes(1, 1, "FLEET_STATE", bytes.substr(at, 20)) + EventBytes(2, 1, "FLEET_STATE", "x");
  const std::string file = Write("undecodable.lcm", bytes + bad);
  const auto info = Json({"info", file, "--json"});
  for (const auto& channel : info["channels"]) {
    EXPECT_EQ(channel["undecodable"], channel["name"] == "FLEET_STATE" ? 2 : 0) << channel;
  }
  EXPECT_EQ(Lines(Output({"csv", file, "--channel", "FLEET_STATE"})).size(),
            Lines(Output({"csv", flight(), "--channel", "FLEET_STATE"})).size());
}

TEST_F(LogTest, SaysWhatIsDamagedAndShowsTheRest) {
  const std::string file = Damaged();
  const auto info = Json({"info", file, "--json"});
  ASSERT_EQ(info["damage"].size(), 2U);
  EXPECT_EQ(info["damage"][1]["reason"], "the last event is cut short");
  EXPECT_GT(info["damaged_bytes"], 4000);
  EXPECT_NE(Output({"info", file}).find("could not be read"), std::string::npos);
  for (const auto& command : kEveryCommand) EXPECT_FALSE(Output(With(command, file)).empty()) << command[0];
  EXPECT_EQ(Run({"diff", file, flight()}).exit_code, 0);
  EXPECT_EQ(Run({"cut", file, "--from", "5", "--to", "35", "--out", In("damaged-cut.lcm")}).exit_code, 0);
}

TEST_F(LogTest, RefusesWhatIsNoRecording) {
  auto commands = kEveryCommand;
  commands.push_back({"cut", "--out", In("never.lcm")});
  commands.push_back({"diff", flight()});
  const std::string text = Write("text.lcm", "t_s,vehicle_id\n");
  const std::string empty = Write("empty.lcm", "");
  const std::string sparse = Write("sparse.lcm", "");
  std::filesystem::resize_file(sparse, 10ULL << 30);
  for (const auto& command : commands) {
    EXPECT_EQ(Refusal(With(command, text)), text + ": is not an LCM log: there is no event in it")
        << command[0];
    EXPECT_EQ(Refusal(With(command, empty)), empty + ": is empty: nothing was recorded") << command[0];
    EXPECT_EQ(Refusal(With(command, sparse)), sparse + ": is not an LCM log: there is no event in it");
    EXPECT_EQ(Refusal(With(command, folder_)), folder_.string() + ": is a folder, not a log") << command[0];
    EXPECT_NE(Refusal(With(command, "/no/such.lcm")).find("No such file"), std::string::npos) << command[0];
  }
  EXPECT_FALSE(std::filesystem::exists(In("never.lcm")));
}

TEST_F(LogTest, ManagesWithALogInWhichNobodyFlies) {
  const std::string file =
      Write("foreign-only.lcm", EventBytes(0, 5, "POSE", "abc") + EventBytes(1, 6, "POSE", "x"));
  EXPECT_NE(Output({"info", file}).find("scenario  unknown: no FLEET_ROSTER was recorded"),
            std::string::npos);
  EXPECT_EQ(Output({"events", file}), "no events\n");
  EXPECT_EQ(Json({"events", file, "--json"}).size(), 0U);
  EXPECT_NE(Refusal({"csv", file, "--channel", "FLEET_STATE"}).find("there are POSE"), std::string::npos);
  EXPECT_NE(Refusal({"csv", file, "--channel", "POSE"}).find("none of the 2 messages on POSE"),
            std::string::npos);
  for (const char* command : {"geojson", "kml", "plot"}) {
    EXPECT_NE(Refusal({command, file}).find("no FLEET_ROSTER was recorded"), std::string::npos) << command;
  }
  EXPECT_NE(Refusal({"diff", file, flight()}).find("no FLEET_ROSTER was recorded"), std::string::npos);
}

TEST_F(LogTest, ListsEvents) {
  const auto events = Json({"events", flight(), "--json"});
  std::set<std::string> codes;
  for (const auto& event : events) codes.insert(event["code"]);
  EXPECT_TRUE(codes.contains("link_cut"));
  EXPECT_TRUE(codes.contains("link_lost"));
  const auto warnings = Json({"events", flight(), "--json", "--least", "warning"});
  ASSERT_FALSE(warnings.empty());
  EXPECT_LT(warnings.size(), events.size());
  for (const auto& event : warnings) EXPECT_EQ(event["severity"], 3);
  for (const auto& event : Json({"events", flight(), "--json", "--from", "19", "--to", "21"})) {
    EXPECT_GE(event["t_s"], 19);
    EXPECT_LE(event["t_s"], 21);
  }
  EXPECT_NE(Output({"events", flight()}).find("    20.00  info      link_cut"), std::string::npos)
      << Output({"events", flight()});
}

TEST_F(LogTest, WritesARowForEachUavOfAMessage) {
  const auto lines =
      Lines(Output({"csv", flight(), "--channel", "FLEET_STATE", "--from", "1", "--to", "2.01"}));
  ASSERT_EQ(lines.size(), 1U + 21 * 3);
  EXPECT_EQ(lines[0],
            "t_s,utime,session_id,tick,chunk,chunk_count,vehicles.utime,vehicles.id,vehicles.east_m,"
            "vehicles.north_m,vehicles.up_m,vehicles.speed_m_s,vehicles.course_rad,vehicles.climb_rad,"
            "vehicles.command_session_id,vehicles.command_sequence,vehicles.payload_on");
  std::vector<std::string> cells;
  std::istringstream stream(lines[3]);
  for (std::string cell; std::getline(stream, cell, ',');) cells.push_back(cell);
  ASSERT_EQ(cells.size(), 17U);
  EXPECT_EQ(cells[7], "3");
  EXPECT_NEAR(std::stod(cells[9]), 50, 3);
  EXPECT_EQ(cells[16], "0");
}

TEST_F(LogTest, WritesListsAndTextsOfAMessageIntoCells) {
  const auto lines = Lines(Output({"csv", flight(), "--channel", "FORMATION"}));
  EXPECT_NE(lines[0].find(",hold,parameters.name,parameters.value,slots.vehicle_id,slots.forward_m"),
            std::string::npos)
      << lines[0];
  EXPECT_NE(lines[1].find(",1,Alpha,skein,column,500,"), std::string::npos) << lines[1];
  for (const std::string& line : lines) EXPECT_EQ(Count(line, ","), Count(lines[0], ",")) << line;
}

TEST(LogText, IsSafeInTerminalsAndTables) {
  EXPECT_EQ(Printable("f\xC3\xBCnf \xE2\x9C\x88 \xF0\x9F\x9B\xA9"),
            "f\xC3\xBCnf \xE2\x9C\x88 \xF0\x9F\x9B\xA9");
  EXPECT_EQ(Printable("\x1b[2J\n\x7f"), "?[2J??");
  EXPECT_EQ(Printable("\xC2\x9B"
                      "2J \xFF \xC0\xAF \xED\xA0\x80 \xE2\x9C"),
            "??2J ? ?? ??? ??");
  EXPECT_EQ(CsvCell("UAV1, UAV2"), "\"UAV1, UAV2\"");
  EXPECT_EQ(CsvCell("say \"no\""), "\"say \"\"no\"\"\"");
  EXPECT_EQ(CsvCell("plain"), "plain");
}

TEST(LogText, TellsTimesAndSizes) {
  EXPECT_EQ(IsoTime(1'577'836'800'050'999), "2020-01-01T00:00:00.050Z");
  EXPECT_EQ(IsoTime(-5), "1970-01-01T00:00:00.000Z");
  EXPECT_EQ(IsoTime(std::numeric_limits<bus::Utime>::max()), "9999-12-31T23:59:59.999Z");
  EXPECT_EQ(ByteText(999), "999 B");
  EXPECT_EQ(ByteText(999'999), "1.0 MB");
  EXPECT_EQ(ByteText(2'100'000'000), "2.1 GB");
  EXPECT_EQ(DurationText(35.24), "35.2 s");
  EXPECT_EQ(DurationText(3909), "1 h 05 min 09 s");
}

TEST_F(LogTest, SaysWhichChannelsThereAre) {
  const std::string refusal = Refusal({"csv", flight(), "--channel", "FLEET"});
  EXPECT_NE(refusal.find("there is nothing on FLEET in this time; there are "), std::string::npos) << refusal;
  EXPECT_NE(refusal.find("FLEET_STATE"), std::string::npos) << refusal;
}

TEST_F(LogTest, CutsAPartThatBeginsWithTheWholeState) {
  const std::string file = In("cut.lcm");
  Run({"cut", flight(), "--from", "10.03", "--to", "25", "--out", file});
  const auto whole = Json({"info", flight(), "--json"});
  const auto info = Json({"info", file, "--json"});
  EXPECT_NEAR(info["duration_s"], 15, 0.1);
  EXPECT_NEAR(info["start_utime"].get<double>() - whole["start_utime"].get<double>(), 10.05e6, 1);
  EXPECT_TRUE(info["damage"].empty());
  for (const auto& channel : info["channels"]) {
    for (const char* state :
         {"FLEET_ROSTER", "FORMATION", "PATH", "FORMATION_STATUS", "PROXIMITY", "LINK_STATUS", "ALARMS"}) {
      if (channel["name"] == state) {
        EXPECT_EQ(channel["first_s"], 0) << channel;
      }
    }
  }
  // What happened is there once, and nothing from before.
  EXPECT_EQ(Json({"events", file, "--json"}).size(),
            Json({"events", flight(), "--json", "--from", "10.03", "--to", "25"}).size());
  lcm::LogFile other(file, "r");
  std::int64_t number = 0;
  while (const lcm::LogEvent* event = other.readNextEvent()) EXPECT_EQ(event->eventnum, number++);
  EXPECT_EQ(info["messages"], number);
}

TEST_F(LogTest, RefusesACutThatHoldsNothing) {
  EXPECT_NE(Refusal({"cut", flight(), "--from", "50", "--out", In("never.lcm")})
                .find("the recording is 40.0 s long"),
            std::string::npos);
  const std::string gap =
      "nothing was recorded from 20.001 s to 20.002 s; before and after there is something";
  EXPECT_EQ(Refusal({"cut", flight(), "--from", "20.001", "--to", "20.002", "--out", In("never.lcm")}),
            flight() + ": " + gap);
  EXPECT_EQ(Refusal({"cut", flight(), "--from", "9", "--to", "8", "--out", In("never.lcm")}),
            "--to must be later than --from");
  EXPECT_FALSE(std::filesystem::exists(In("never.lcm")));
}

TEST_F(LogTest, SaysThatAFlightAgreesWithItself) {
  const auto ran = Run({"diff", flight(), flight(), "--tolerance-m", "0.001"});
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.output.find("the flights agree within 0.001 m"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("m\n\n"), std::string::npos) << "without a reservation: " << ran.output;
  const auto diff = Json({"diff", flight(), flight(), "--json"});
  EXPECT_EQ(diff["whole"], true);
  EXPECT_EQ(diff["ends_first"], nullptr);
  EXPECT_EQ(diff["vehicles"][0]["greatest_m"], 0);
  EXPECT_NEAR(diff["vehicles"][0]["compared_s"], 40, 0.2);
  // UAV3 was silent for some of it, in both.
  EXPECT_LT(diff["vehicles"][2]["heard_s"], 32);
}

TEST_F(LogTest, TellsWhatOfTwoFlightsCouldNotBeCompared) {
  const std::string silent = In("silent.lcm");
  Fly(silent, [](config::Scenario& scenario) {
    scenario.timeline.clear();
    scenario.formations.clear();
  });
  const std::vector<std::string> words{"diff", flight(), silent, "--tolerance-m", "100000"};
  const auto ran = Run(words);
  EXPECT_EQ(ran.exit_code, 0);
  EXPECT_NE(ran.output.find(
                "the flights agree within 100000 m where they can be compared: UAV3 for 29.9 of 40.0 s only"),
            std::string::npos)
      << ran.output;
  const auto diff = Json({"diff", flight(), silent, "--tolerance-m", "100000", "--json"});
  EXPECT_EQ(diff["agree"], true);
  EXPECT_EQ(diff["whole"], false);
  EXPECT_LT(diff["vehicles"][2]["compared_s"], diff["vehicles"][2]["heard_s"]);

  const std::string half = In("half.lcm");
  Run({"cut", flight(), "--from", "0", "--to", "15", "--out", half});
  for (const bool swapped : {false, true}) {
    const auto part = Run({"diff", swapped ? half : flight(), swapped ? flight() : half});
    EXPECT_EQ(part.exit_code, 0);
    EXPECT_NE(part.output.find("the flights agree within 1 m where they can be compared: up to 1"),
              std::string::npos)
        << part.output;
  }
  EXPECT_EQ(Json({"diff", flight(), half, "--json"})["ends_first"], "second");
}

TEST_F(LogTest, TakesUavsThatWereNeverHeardTogetherForNoAgreement) {
  const std::string lost = In("lost.lcm");
  Fly(lost, [](config::Scenario& scenario) {
    std::erase_if(scenario.timeline, [](const config::TimelineEntry& entry) { return entry.at_s > 25; });
  });
  // UAV3 is heard up to 20 s in the one and from 30 s on in the other.
  const std::string late = In("late.lcm");
  Run({"cut", flight(), "--from", "25", "--out", late});
  const auto ran = Run({"diff", lost, late, "--tolerance-m", "100000"});
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_NE(ran.output.find("not every UAV was heard at the same time in both"), std::string::npos)
      << ran.output;
  const auto diff = Json({"diff", lost, late, "--tolerance-m", "100000", "--json"});
  EXPECT_EQ(diff["agree"], false);
  EXPECT_EQ(diff["vehicles"][2]["only_in"], nullptr);
  EXPECT_EQ(diff["vehicles"][2]["compared_states"], 0);
}

TEST_F(LogTest, FindsWhereTwoFlightsPart) {
  // Without the drop nobody climbs: UAV1 and UAV2 part from those that did.
  const std::string other = In("other.lcm");
  Fly(other, [](config::Scenario& scenario) { scenario.timeline.clear(); });
  const auto ran = Run({"diff", flight(), other, "--json"});
  EXPECT_EQ(ran.exit_code, 1);
  const auto diff = nlohmann::json::parse(ran.output);
  EXPECT_FALSE(diff["agree"]);
  EXPECT_GT(diff["parts_s"], 20);
  EXPECT_LT(diff["parts_s"], 27);
  EXPECT_NE(diff["parts_vehicle_id"], 3);
  EXPECT_GT(diff["vehicles"][0]["greatest_m"], 20);
  EXPECT_NE(Output({"diff", flight(), other}).find("the flights part at 2"), std::string::npos);
  EXPECT_EQ(Run({"diff", flight(), other, "--tolerance-m", "1000"}).exit_code, 0);
}

TEST_F(LogTest, TellsUavsThatFlyInOneRecordingOnly) {
  const std::string other = In("two.lcm");
  Fly(other, [](config::Scenario& scenario) {
    scenario.timeline.clear();
    scenario.formations.clear();
    scenario.vehicles.pop_back();
  });
  const auto ran = Run({"diff", flight(), other, "--tolerance-m", "100000"});
  EXPECT_EQ(ran.exit_code, 1);
  EXPECT_NE(ran.output.find("the flights are not of the same UAVs"), std::string::npos) << ran.output;
  EXPECT_NE(ran.output.find("UAV3  only in the first"), std::string::npos) << ran.output;
}

TEST_F(LogTest, ReplacesNoRecordingThatItReadsNotEvenWhenAsked) {
  const std::string bytes = Read(flight());
  const std::string file = Write("mine.lcm", bytes);
  const std::string part = Write("mine.lcm.01", bytes);
  const std::vector<std::vector<std::string>> commands = {
      {"csv", "--channel", "EVENT"}, {"geojson"}, {"kml"}, {"plot"}, {"cut", "--from", "1"}};
  for (const auto& command : commands) {
    for (const std::string& out : {file, part, (folder_ / "./mine.lcm").string()}) {
      auto words = With(command, file);
      words.insert(words.end(), {"--out", out, "--force"});
      EXPECT_EQ(Refusal(words), out + ": is what is read; write into another file");
    }
  }
  EXPECT_EQ(Read(file), bytes);
  EXPECT_EQ(Read(part), bytes);
}

TEST_F(LogTest, SaysInWordsWhatANumberMustBe) {
  const auto wrong = [&](const std::vector<std::string>& words) {
    try {
      Run(words);
    } catch (const CLI::ParseError& error) {
      return std::string(error.what());
    }
    return std::string();
  };
  EXPECT_EQ(wrong({"cut", flight(), "--from", "-5", "--out", "x"}), "--from: must be 0 .. 1e9, is -5");
  EXPECT_EQ(wrong({"cut", flight(), "--from", "1e300", "--out", "x"}), "--from: must be 0 .. 1e9, is 1e300");
  EXPECT_EQ(wrong({"cut", flight(), "--to", "nan", "--out", "x"}), "--to: must be 0 .. 1e9, is nan");
  EXPECT_EQ(wrong({"csv", flight(), "--channel", "EVENT", "--from", "soon"}),
            "--from: must be 0 .. 1e9, is soon");
  EXPECT_EQ(wrong({"events", flight(), "--least", "bogus"}),
            "--least: must be info, advisory, caution or warning, is bogus");
  EXPECT_EQ(wrong({"events", flight(), "--least", "Caution"}), "");
}

TEST_F(LogTest, ReplacesNoFileUnasked) {
  const std::string file = Write("kept.csv", "mine");
  EXPECT_EQ(Refusal({"csv", flight(), "--channel", "EVENT", "--out", file}),
            file + ": exists already; --force replaces it");
  EXPECT_EQ(Read(file), "mine");
  Run({"csv", flight(), "--channel", "EVENT", "--out", file, "--force"});
  EXPECT_EQ(Read(file), Output({"csv", flight(), "--channel", "EVENT"}));
  // One that fails leaves nothing behind, and what was there as it was.
  EXPECT_NE(Refusal({"csv", flight(), "--channel", "NONE", "--out", file, "--force"}), "");
  EXPECT_NE(Read(file), "");
  for (const auto& entry : std::filesystem::directory_iterator(folder_)) {
    EXPECT_EQ(entry.path().string().find(".part-"), std::string::npos) << entry.path();
  }
  EXPECT_NE(Refusal({"csv", flight(), "--channel", "EVENT", "--out", folder_}).find("is a folder"),
            std::string::npos);
  EXPECT_NE(
      Refusal({"csv", flight(), "--channel", "EVENT", "--out", "/no/such/x.csv"}).find("cannot be written"),
      std::string::npos);
}

TEST(LogUsage, RefusesWhatMakesNoSense) {
  for (const std::vector<std::string>& words :
       std::vector<std::vector<std::string>>{{"log"},
                                             {"log", "info"},
                                             {"log", "csv", "x.lcm"},
                                             {"log", "plot", "x.lcm", "--figure", "7"},
                                             {"log", "cut", "x.lcm", "--from", "3"},
                                             {"log", "diff", "x.lcm"},
                                             {"log", "events", "x.lcm", "--least", "loud"},
                                             {"log", "info", "x.lcm", "--from", "-3"}}) {
    CommandLine command_line;
    std::vector<std::string> reversed(words.rbegin(), words.rend());
    EXPECT_THROW(command_line.app().parse(reversed), CLI::ParseError) << testing::PrintToString(words);
  }
}

}  // namespace
}  // namespace skein::cli
