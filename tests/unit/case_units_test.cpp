// Law: a value with a unit is the double nearest to its exact decimal value in SI (IEEE 754 round to nearest), for
// every unit that is a power of ten of SI, and for inch, foot and pound, whose definitions are finite decimals
// (international yard and pound, 1959). Tolerance zero there. psi and quotients by inches are not finite decimals: they
// are rounded three times, in long double and once to double, hence 1 ulp of double (2.2e-16 relative).
#include <cstdlib>

#include <gtest/gtest.h>

#include "coupling/base/counter_random.hpp"
#include "coupling/case/near_word.hpp"
#include "coupling/case/units.hpp"

namespace standoff {
namespace {

struct Sample {
  const char* text;
  double si;
  Quantity quantity;
};

TEST(Units, EachWayOfWriting_GivesTheNearestDouble) {
  const Quantity area{"area", {{0, 2, 0, 0}}, "m2", "m2"};
  const Sample samples[] = {{"3.4 mm", 0.0034, quantity::length},
                            {"76.2 mm", 0.0762, quantity::length},
                            {"150mm", 0.15, quantity::length},
                            {"-0.2 m", -0.2, quantity::length},
                            {"3 in", 0.0762, quantity::length},
                            {"1.5 ft", 0.4572, quantity::length},
                            {"28 \u00b5m", 28e-6, quantity::length},
                            {"15 g", 0.015, quantity::mass},
                            {"1 lb", 0.45359237, quantity::mass},
                            {"2 ms", 0.002, quantity::time},
                            {"5e0 us", 5e-6, quantity::time},
                            {"296 K", 296.0, quantity::temperature},
                            {"0.4 GN/m", 4e8, quantity::stiffness},
                            {"1601 kg/m3", 1601.0, quantity::density},
                            {"1.601 g/cm^3", 1601.0, quantity::density},
                            {"8.7 GJ/m3", 8.7e9, quantity::energy_density},
                            {"8.7 kJ/cm\u00b3", 8.7e9, quantity::energy_density},
                            {"101.3 kPa", 101300.0, quantity::pressure},
                            {"1.013 bar", 101300.0, quantity::pressure},
                            {"1 atm", 101325.0, quantity::pressure},
                            {"0.001 1/s", 0.001, quantity::rate},
                            {"1/s", 1.0, quantity::rate},
                            {"1_000 s-1", 1000.0, quantity::rate},
                            {"130 N s", 130.0, quantity::impulse},
                            {"130 N*s", 130.0, quantity::impulse},
                            {"0.5 kJ/(kg K)", 500.0, quantity::specific_heat},
                            {"500 J/kg/K", 500.0, quantity::specific_heat},
                            {"1.5e-5 1/K", 1.5e-5, quantity::expansion},
                            {"8.19 km/s", 8190.0, quantity::speed},
                            {"2 in2", 0.00129032, area},
                            {"0.3", 0.3, quantity::none}};
  for (const Sample& sample : samples) {
    const ParsedQuantity parsed = parse_quantity(sample.text);
    EXPECT_EQ(parsed.error, "") << sample.text;
    EXPECT_EQ(dimension_mismatch(parsed.dimension, sample.quantity), "") << sample.text;
    EXPECT_EQ(parsed.value, sample.si) << sample.text;
  }
}

TEST(Units, PoundPerSquareInch_IsWithinOneUlp) {
  // lbf / in2 = 0.45359237 * 9.80665 / 0.0254^2 Pa, to 20 digits by hand: 6894.7572931683613367
  EXPECT_NEAR(parse_quantity("1 psi").value / 6894.7572931683613367, 1.0, 2.3e-16);
  EXPECT_NEAR(parse_quantity("1 ksi").value / 6894757.2931683613367, 1.0, 2.3e-16);
}

TEST(Units, RandomDecimalsWithPrefixes_AreTheSameBitsAsTheScaledLiteral) {
  const std::pair<const char*, int> units[] = {{"km", 3}, {"m", 0}, {"cm", -2}, {"mm", -3}, {"um", -6}, {"nm", -9}};
  for (std::uint32_t i = 0; i < 20000; ++i) {
    CounterRandom random(7, RandomUse::test, i);
    const auto digits = static_cast<long long>(random.uniform() * 1e17);
    const int point = static_cast<int>(random.uniform() * 17.0);
    const auto& [unit, ten] = units[i % 6];
    std::string text = std::to_string(digits);
    text.insert(0, 18 > text.size() ? 18 - text.size() : 0, '0');
    text.insert(text.size() - static_cast<std::size_t>(point), 1, '.');
    if (text.back() == '.') text += '0';
    const std::string literal = text + "e" + std::to_string(ten);
    ASSERT_EQ(parse_quantity(text + " " + unit).value, std::strtod(literal.c_str(), nullptr)) << text << " " << unit;
  }
}

TEST(Units, ResolvedText_ReadsBackToTheSameBits) {
  for (std::uint32_t i = 0; i < 20000; ++i) {
    CounterRandom random(8, RandomUse::test, i);
    const double value = (random.uniform() - 0.5) * std::pow(10.0, 40.0 * random.uniform() - 20.0);
    for (const Quantity& q :
         {quantity::length, quantity::mass, quantity::specific_heat, quantity::rate, quantity::none}) {
      const ParsedQuantity back = parse_quantity(exact_text(value, q));
      ASSERT_EQ(back.error, "") << exact_text(value, q);
      ASSERT_EQ(back.value, value) << exact_text(value, q);
      ASSERT_EQ(dimension_mismatch(back.dimension, q), "");
    }
  }
}

TEST(Units, WrongDimension_SaysWhatItIsAndWhatIsNeeded) {
  const auto mismatch = [](const char* text, const Quantity& wanted) {
    return dimension_mismatch(parse_quantity(text).dimension, wanted);
  };
  EXPECT_EQ(mismatch("150 kg", quantity::length), "is a mass; a length is needed (m, cm, mm, in, ft)");
  EXPECT_EQ(mismatch("3", quantity::time), "is a plain number; a time is needed (s, ms, us)");
  EXPECT_EQ(mismatch("3 m2", quantity::length), "is an area; a length is needed (m, cm, mm, in, ft)");
  EXPECT_EQ(mismatch("5 MJ/kg", quantity::density), "is an energy per mass; a density is needed (kg/m3, g/cm3)");
  EXPECT_EQ(mismatch("5 kg2 m", quantity::temperature), "is a quantity in kg2 m; a temperature is needed (K)");
}

TEST(Units, UnreadableText_IsAnErrorAndNeverANumber) {
  for (const char* text :
       {"",        "mm",   "fast",  "1.2.3 mm", "3 furlong", "3 mmm",  "3 m^",  "3 m^0", "3 (m", "3 m)",  "3 2 m",
        "1e999 m", "3 m/", "3 mm;", "nan m",    "inf m",     "0x10 m", "3 m12", "--3 m", "3 ()", "1,5 mm"})
    EXPECT_NE(parse_quantity(text).error, "") << "\"" << text << "\" was read as " << parse_quantity(text).value;
  EXPECT_EQ(parse_quantity("3 mmm").error, "unknown unit \"mmm\"; did you mean \"mm\"?");
  EXPECT_EQ(parse_quantity("3 Mpa").error, "unknown unit \"Mpa\"; did you mean \"MPa\"?");
}

TEST(NearestWord, SlipsOfTheFingers_AreRecognisedAndOtherWordsAreNot) {
  const std::vector<std::string> keys{"model", "material", "size", "elements", "edges"};
  EXPECT_EQ(nearest_word("materal", keys), "material");
  EXPECT_EQ(nearest_word("Size", keys), "size");
  EXPECT_EQ(nearest_word("element", keys), "elements");
  EXPECT_EQ(nearest_word("temperature", keys), "");
  EXPECT_EQ(edit_distance("kitten", "sitting"), 3);  // Wagner and Fischer, J. ACM 21 (1974) 168: the textbook pair
  EXPECT_EQ(edit_distance("ab", "ba"), 1);
}

}  // namespace
}  // namespace standoff
