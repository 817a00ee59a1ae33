// FAppearanceChanges: what of a material lights its surroundings otherwise, and which objects have it.
#include "LanternScene/Scene/CasterChanges.h"

#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

TEST(FAppearanceTest, ComparesWhatIsReflectedAndEmitted)
{
	FMaterialData Old{};
	Old.BaseColor = {0.5f, 0.5f, 0.5f, 1.0f};
	FMaterialData New = Old;
	EXPECT_EQ(CompareAppearance(Old, New).Part, 0.0);
	New.NormalScale = 0.5f;
	EXPECT_EQ(CompareAppearance(Old, New).Part, 0.0) << "as much light comes back";
	New = Old;
	New.BaseColor = {0.25f, 0.25f, 0.25f, 1.0f};
	EXPECT_NEAR(CompareAppearance(Old, New).Part, 0.5, 1e-6);
	EXPECT_EQ(CompareAppearance(Old, New).Emission, 0.0);
	New = Old;
	New.Textures[TEXTURE_BASE_COLOR] = 7;
	EXPECT_EQ(CompareAppearance(Old, New).Part, 1.0);
	New = Old;
	New.UVOffset[TEXTURE_BASE_COLOR] = {0.5f, 0.0f};
	EXPECT_GT(CompareAppearance(Old, New).Part, 0.0);
	EXPECT_LT(CompareAppearance(Old, New).Part, 0.1) << "it scrolls";
	New = Old;
	New.Textures[TEXTURE_EMISSIVE] = 7;
	EXPECT_EQ(CompareAppearance(Old, New).Part, 0.0) << "it emits nothing";
	New.LightEmissive = glm::vec3(10.0f);
	New.EmissiveWeight = 10.0f;
	EXPECT_EQ(CompareAppearance(Old, New).Part, 1.0);
	EXPECT_EQ(CompareAppearance(Old, New).Emission, 64.0 * 10.0) << "the weight is a 64th of the luminance";
	FMaterialData Dim = New;
	Dim.LightEmissive = glm::vec3(9.0f);
	Dim.EmissiveWeight = 9.0f;
	EXPECT_NEAR(CompareAppearance(New, Dim).Part, 0.1, 1e-6);
}

class FAppearanceChangesSceneTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		Lamp = MakeMaterial(0, 2.0f);
		Lamp.LightEmissive = glm::vec3(2.0f);
		Material = Scene->AddMaterial(Lamp);
		Other = Scene->AddMaterial(MakeMaterial());
		FGeometryOptions Options;
		Options.bCpuData = true;
		Rock = MakeGeometry("rock", 1, Options);
	}
	/// Objects told of since the last call, in the order of their slots.
	std::vector<uint32_t> Take()
	{
		std::vector<uint32_t> Slots;
		EXPECT_TRUE(Scene->GetAppearanceChanges().GetObjects().Find(Since, Found));
		Since = Scene->GetAppearanceChanges().GetObjects().GetCount();
		for (const FCasterChange& Change : Found) { Slots.push_back(Change.Object); }
		std::ranges::sort(Slots);
		return Slots;
	}
	void Dim(float Emission)
	{
		Lamp.LightEmissive = glm::vec3(Emission);
		Lamp.EmissiveWeight = Emission;
		Scene->SetMaterial(Material, Lamp);
	}

	FMaterialData Lamp;
	uint32_t Material = 0, Other = 0;
	FRTGeometryRef Rock;
	uint64_t Since = 0;
	std::vector<FCasterChange> Found;
};

TEST_F(FAppearanceChangesSceneTest, TellsTheObjectsOfAMaterial)
{
	const FRTObjectId A = Add(Rock, {Material}), B = Add(Rock, {Other}), C = Add(Rock, {Material}, {7, 0, 0});
	Settle();
	const uint64_t Casters = Scene->GetCasterChanges().GetCount();
	Dim(1.0f);
	EXPECT_EQ(Take(), (std::vector<uint32_t>{A.Index, C.Index}));
	EXPECT_LT(Found[0].Changed, 0.1) << "it hides what it did";
	EXPECT_NEAR(Found[0].Emission * Found[0].Changed, 64.0, 1e-6) << "half of its light";
	EXPECT_EQ(Scene->GetCasterChanges().GetCount(), Casters) << "shadows are as they were";
	Dim(1.0f);
	EXPECT_TRUE(Take().empty()) << "nothing has changed";
	Scene->SetMaterials(B, {Material});
	Scene->SetMaterials(A, {Other});
	Dim(0.0f);
	EXPECT_EQ(Take(), (std::vector<uint32_t>{B.Index, C.Index}));
	Scene->RemoveObject(C);
	Dim(1.0f);
	EXPECT_EQ(Take(), (std::vector<uint32_t>{B.Index}));
	const FRTObjectId D = Add(Rock, {Material});
	EXPECT_EQ(D.Index, C.Index);
	Dim(2.0f);
	EXPECT_EQ(Take(), (std::vector<uint32_t>{B.Index, D.Index}));
	Scene->RemoveObject(B);
	Scene->RemoveObject(D);
	Dim(1.0f);
	EXPECT_TRUE(Take().empty()) << "nobody has it";
	EXPECT_EQ(Scene->GetAppearanceChanges().GetEverywhere(), 0.0);
}

TEST_F(FAppearanceChangesSceneTest, AMaterialOfManyObjectsChangesEverywhere)
{
	for (uint32_t I = 0; I < FAppearanceChanges::MostObjects; ++I) { Add(Rock, {Material}, {double(I), 0, 0}); }
	Settle();
	Dim(1.0f);
	EXPECT_EQ(Take().size(), FAppearanceChanges::MostObjects);
	EXPECT_EQ(Scene->GetAppearanceChanges().GetEverywhere(), 0.0);
	Add(Rock, {Material});
	Settle();
	Dim(2.0f);
	EXPECT_TRUE(Take().empty());
	EXPECT_NEAR(Scene->GetAppearanceChanges().GetEverywhere(), 0.5, 1e-6);
}

} // namespace
} // namespace Lantern
