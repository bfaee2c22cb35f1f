// What `doc`, `effects`, `presets`, `models` and `new` tell must be what the case reader does: the tables agree with
// the schema, presets in SI read back to the same value, and the template case is accepted at every level. All exact.
#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <unistd.h>

#include "coupling/case/case_reader.hpp"
#include "coupling/case/effects/registry.hpp"
#include "coupling/case/presets.hpp"
#include "coupling/case/schema.hpp"
#include "coupling/launcher/catalogue.hpp"
#include "coupling/launcher/template_case.hpp"

namespace standoff::launch {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;

TEST(Catalogue_Doc, EveryKeyOfTheSchema_IsFoundByPathAndHasADoc) {
  for (const KeyEntry& entry : schema()) {
    const std::string path(entry.path);
    EXPECT_THAT(keys_named(path), ElementsAre(path));
    const auto j = keys_json({path});
    EXPECT_FALSE(j[0]["doc"].get<std::string>().empty()) << path;
    EXPECT_THAT(keys_text({path}), HasSubstr(path));
  }
}

TEST(Catalogue_Doc, EverySection_IsFound) {
  for (const std::string& section : section_names())
    EXPECT_TRUE(!keys_named(section).empty() || !free_entry_text(section).empty()) << section;
  EXPECT_THAT(keys_named("edges"), ElementsAre("plate.edges"));
  EXPECT_EQ(keys_named("material").size(), keys_named("plate.material").size());
}

TEST(Catalogue_Doc, UnknownKey_SuggestsTheNearest) {
  EXPECT_TRUE(keys_named("plate.sizze").empty());
  EXPECT_THAT(unknown_key_text("plate.sizze"), HasSubstr("did you mean \"size\"?"));
  EXPECT_THAT(unknown_key_text("stand_of"), HasSubstr("did you mean \"stand_off\"?"));
  EXPECT_THAT(unknown_key_text("qqqqqqqq"), HasSubstr("sections: case, charge"));
}

TEST(Catalogue_Doc, QuantityKey_TellsUnitRangeAndDefaultInJson) {
  const auto j = keys_json({"plate.surround_size"})[0];
  EXPECT_EQ(j["unit"], "m");
  EXPECT_EQ(j["range"]["low"], 0.0);
  EXPECT_EQ(j["range"]["low_open"], true);
  EXPECT_TRUE(j["range"]["high"].is_null());
  EXPECT_EQ(j["default"], "613 mm");
}

TEST(Catalogue_Effects, List_IsThatOfTheRules) {
  const auto j = effects_json();
  ASSERT_EQ(j.size(), effect_names().size());
  for (std::size_t i = 0; i < j.size(); ++i) EXPECT_EQ(j[i]["name"], effect_names()[i]);
}

TEST(Catalogue_Models, List_IsTheChoiceOfTheSchema) {
  std::set<std::string> listed;
  for (const auto& model : models_json()) listed.insert(model["name"].get<std::string>());
  const std::vector<std::string> words = find_key("plate.model")->word_list();
  EXPECT_EQ(listed, std::set<std::string>(words.begin(), words.end()));
}

TEST(Catalogue_Presets, ValuesInSI_ReadBackToTheSameValueAndHaveASource) {
  const auto list = presets_json();
  ASSERT_EQ(list.size(), presets().size());
  for (std::size_t p = 0; p < list.size(); ++p) {
    const Preset& preset = presets()[p];
    EXPECT_EQ(list[p]["name"], std::string(preset.name));
    EXPECT_GE(list[p]["values"].size() + 2, preset.values.size()) << "all but name and source";
    for (const auto& shown : list[p]["values"]) {
      EXPECT_FALSE(shown["source"].get<std::string>().empty()) << shown;
      const KeyEntry& key = *find_key(shown["key"].get<std::string>());
      if (key.kind != KeyKind::quantity) continue;
      const auto stated = std::find_if(preset.values.begin(), preset.values.end(),
                                       [&](const PresetValue& value) { return value.path == key.path; });
      EXPECT_EQ(parse_quantity(shown["value"].get<std::string>()).value, parse_quantity(stated->text).value) << shown;
      EXPECT_TRUE(shown["value"].get<std::string>().ends_with(key.quantity.si)) << shown;
    }
  }
}

TEST(TemplateCase, EveryLevel_IsAcceptedWithoutAWord) {
  const auto folder = std::filesystem::temp_directory_path() / ("launch_template_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  std::ofstream(folder / "case.toml") << template_case;
  for (const char* level : {"", "coarse", "medium"}) {
    CaseOverrides overrides;
    overrides.level = level;
    const CaseRead read = read_case(folder.string(), overrides);
    EXPECT_TRUE(read.errors.empty()) << read.errors.front();
    EXPECT_TRUE(read.warnings.empty()) << read.warnings.front();
  }
  std::filesystem::remove_all(folder);
}

}  // namespace
}  // namespace standoff::launch
