// SPDX-License-Identifier: BSD-3-Clause
// The survey of labels against the ledger's own, which is made otherwise.
#include "LabelSurvey.h"

#include <gtest/gtest.h>

#include <random>

using namespace LabelMesh;

namespace
{
std::vector<MaterialId> Random(const std::array<int, 3>& dims, int numberOfIds, unsigned int seed)
{
  std::mt19937 random(seed);
  std::vector<MaterialId> ids(std::size_t(dims[0]) * dims[1] * dims[2]);
  for (MaterialId& id : ids)
  {
    id = MaterialId(random() % numberOfIds);
  }
  return ids;
}
}

TEST(LabelSurvey, AgreesWithTheVoxelObjects)
{
  unsigned int seed = 1;
  for (const std::array<int, 3>& dims :
    { std::array<int, 3>{ 5, 4, 3 }, std::array<int, 3>{ 1, 7, 2 }, std::array<int, 3>{ 9, 1, 1 } })
  {
    for (const int numberOfIds : { 1, 2, 5, 40 })
    {
      const std::vector<MaterialId> ids = Random(dims, numberOfIds, seed++);
      const MaterialId background = MaterialId(seed % numberOfIds);
      const LabelSurvey survey = SurveyLabels(dims, ids, background, numberOfIds, Monitor());
      const VoxelObjects objects = FindVoxelObjects(dims, ids, background, numberOfIds);
      ASSERT_EQ(survey.Voxels.size(), objects.Objects.size());
      for (std::size_t id = 0; id < survey.Voxels.size(); ++id)
      {
        EXPECT_EQ(survey.Voxels[id], objects.Objects[id].Voxels);
      }
      ASSERT_EQ(survey.Contacts.size(), objects.Contacts.size());
      for (std::size_t n = 0; n < survey.Contacts.size(); ++n)
      {
        EXPECT_EQ(survey.Contacts[n].Ids, objects.Contacts[n].Ids);
        EXPECT_EQ(survey.Contacts[n].Faces, objects.Contacts[n].Faces);
      }
    }
  }
}

TEST(LabelSurvey, ABlockTouchesTheBackgroundOutside)
{
  const std::array<int, 3> dims = { 2, 3, 4 };
  const LabelSurvey survey = SurveyLabels(dims, std::vector<MaterialId>(24, 1), 0, 2, Monitor());
  EXPECT_EQ(survey.Voxels, (std::vector<Index>{ 0, 24 }));
  ASSERT_EQ(survey.Contacts.size(), 1u);
  EXPECT_EQ(survey.Contacts[0].Faces, 2 * (2 * 3 + 3 * 4 + 2 * 4));
}
