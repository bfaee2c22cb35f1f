// Save and restore of every structural model: a restored model holds the same bits and goes on with the same bits; a
// state of another plate is refused.
#include "tests/contract/structure_model_suite.hpp"

namespace standoff::structure::testing {
namespace {

class StructureModelRestore : public StructureModel {};

TEST_P(StructureModelRestore, Restored_InMidLoad_GoesOnBitForBit) {
  const CaseSpec spec = model_case(GetParam());
  const auto first = make_structural_model(spec, 1), second = make_structural_model(spec, 1);
  Hammer hammer;
  hammer.strike(*first, 123);
  const std::string state = saved(*first);
  StateReader reader(state);
  second->restore(reader);
  EXPECT_TRUE(reader.at_end());
  EXPECT_EQ(saved(*second), state);
  Hammer same = hammer;
  hammer.strike(*first, 150);
  same.strike(*second, 150);
  EXPECT_EQ(hash_of(*first), hash_of(*second));
  EXPECT_TRUE(saved(*first) == saved(*second));
  EXPECT_EQ(first->stable_step(), second->stable_step());
  EXPECT_EQ(first->ledger().balance(), second->ledger().balance());
  EXPECT_EQ(first->extremes().max_strain_rate, second->extremes().max_strain_rate);
}

TEST_P(StructureModelRestore, CutShort_IsRefused) {
  const auto model = make_structural_model(model_case(GetParam()), 1);
  const std::string state = saved(*model);
  StateReader reader(std::span<const char>(state).first(state.size() - 1));
  EXPECT_THROW(model->restore(reader), Stop);
}

TEST_P(StructureModelRestore, StateOfAnotherMesh_IsRefused) {
  const auto model = make_structural_model(model_case(GetParam()), 1);
  if (model->elements() == 0) GTEST_SKIP() << "has no mesh";
  CaseSpec other = model_case(GetParam());
  other.plate.elements = {8, 6, 1};
  const std::string state = saved(*make_structural_model(other, 1));
  StateReader reader(state);
  EXPECT_THROW(model->restore(reader), Stop);
}

INSTANTIATE_TEST_SUITE_P(Registry, StructureModelRestore, ::testing::ValuesIn(structural_model_names()),
                         [](const auto& each) { return each.param; });

}  // namespace
}  // namespace standoff::structure::testing
