// Tables of styles: what shaders look up, through changes.
#include "LanternScene/Scene/ToonStyles.h"
#include "Support/SceneTestTools.h"

namespace Lantern
{
namespace
{

class FToonStylesTest : public FSceneTest
{
protected:
	void SetUp() override
	{
		FSceneTest::SetUp();
		Material = Scene->AddMaterial(MakeMaterial());
		FGeometryOptions Options;
		Options.bCpuData = true;
		Rock = MakeGeometry("rock", 1, Options);
		for (FRTObjectId& Object : Objects) { Object = Add(Rock, {Material}); }
		Settle();
	}
	static std::shared_ptr<const FToonStyle> Make(float Bend, uint8_t Number = 0, float Occlusion = 0.0f, float SphereWeight = 0.0f)
	{
		FToonStyle Style;
		Style.Bend = Bend;
		Style.Number = Number;
		Style.Occlusion = Occlusion;
		Style.SphereWeight = SphereWeight;
		return std::make_shared<const FToonStyle>(Style);
	}
	/// Bend of the style that an object has for shaders; below 0: it has none.
	float FindBend(FRTObjectId Object)
	{
		Frame();
		const FSceneConstants C = Scene->GetConstants();
		if (C.ToonStyles == 0) { return -1.0f; }
		const uint32_t Toon = Read<uint32_t>(C.ObjectToons, Object.Index);
		if (Toon == 0) { return -1.0f; }
		const FToonData Data = Read<FToonData>(C.ToonStyles, Toon - 1);
		EXPECT_EQ(Data.Object, Object.Index);
		return Data.Bend;
	}
	float FindBendOfNumber(uint8_t Number)
	{
		Frame();
		const FSceneConstants C = Scene->GetConstants();
		const uint32_t Toon = C.ToonNumbers != 0 ? Read<uint32_t>(C.ToonNumbers, Number) : 0;
		return Toon != 0 ? Read<FToonData>(C.ToonStyles, Toon - 1).Bend : -1.0f;
	}

	uint32_t Material = 0;
	FRTGeometryRef Rock;
	FRTObjectId Objects[20];
};

TEST_F(FToonStylesTest, NoStyleCostsNoTable)
{
	Frame();
	EXPECT_EQ(Scene->GetConstants().ToonStyles, 0u);
	EXPECT_EQ(Scene->GetConstants().ObjectToons, 0u);
	EXPECT_EQ(Scene->GetConstants().ToonNumbers, 0u);
	EXPECT_FALSE(Scene->RefreshFacts().bToon);
}

TEST_F(FToonStylesTest, ObjectsHaveTheirOwnThroughChanges)
{
	Scene->SetToon(Objects[3], Make(0.25f));
	Scene->SetToon(Objects[17], Make(0.5f, 0, 0.5f));
	EXPECT_EQ(FindBend(Objects[3]), 0.25f);
	EXPECT_EQ(FindBend(Objects[17]), 0.5f);
	EXPECT_EQ(FindBend(Objects[4]), -1.0f);
	EXPECT_TRUE(Scene->RefreshFacts().bToon);
	EXPECT_TRUE(Scene->RefreshFacts().bToonLayer);
	Scene->SetToon(Objects[17], Make(0.75f));
	EXPECT_EQ(FindBend(Objects[17]), 0.75f);
	EXPECT_FALSE(Scene->RefreshFacts().bToonLayer);
	// An object that comes later is in the table as well, and one in a slot used again has its own.
	const FRTObjectId Later = Add(Rock, {Material});
	EXPECT_EQ(FindBend(Later), -1.0f);
	Scene->RemoveObject(Objects[3]);
	const FRTObjectId Again = Add(Rock, {Material});
	EXPECT_EQ(Again.Index, Objects[3].Index);
	EXPECT_EQ(FindBend(Again), -1.0f);
	Scene->SetToon(Again, Make(1.0f));
	EXPECT_EQ(FindBend(Again), 1.0f);
	EXPECT_EQ(FindBend(Objects[17]), 0.75f);
	Scene->SetToon(Again, nullptr);
	Scene->SetToon(Objects[17], nullptr);
	EXPECT_EQ(FindBend(Again), -1.0f);
	EXPECT_FALSE(Scene->RefreshFacts().bToon);
	EXPECT_EQ(Scene->GetConstants().ToonStyles, 0u);
}

TEST_F(FToonStylesTest, ANumberIsThatOfTheLastOneThatGotIt)
{
	Scene->SetToon(Objects[0], Make(0.25f, 9));
	Scene->SetToon(Objects[1], Make(0.5f, 9));
	EXPECT_EQ(FindBendOfNumber(9), 0.5f);
	EXPECT_EQ(FindBendOfNumber(8), -1.0f);
	Scene->SetToon(Objects[0], Make(0.25f, 9));
	EXPECT_EQ(FindBendOfNumber(9), 0.25f) << "set last, though unchanged";
	Scene->SetToon(Objects[2], Make(0.75f, 9));
	Scene->SetToon(Objects[2], nullptr);
	EXPECT_EQ(FindBendOfNumber(9), 0.25f) << "the one before has it again";
	Scene->SetToon(Objects[0], nullptr);
	EXPECT_EQ(FindBendOfNumber(9), 0.5f);
	Scene->SetToon(Objects[1], Make(0.5f, 255));
	EXPECT_EQ(FindBendOfNumber(9), -1.0f);
	EXPECT_EQ(FindBendOfNumber(255), 0.5f);
	Scene->RemoveObject(Objects[1]);
	EXPECT_EQ(FindBendOfNumber(255), -1.0f);
}

// Rays that light a sphere do not see objects with spheres.
TEST_F(FToonStylesTest, SpheresChangeTheMask)
{
	const auto GetMask = [&] { return Scene->GetInstances().GetRecord(Objects[2].Index).Mask; };
	EXPECT_EQ(GetMask(), MaskDefault);
	Scene->SetToon(Objects[2], Make(0.5f));
	EXPECT_EQ(GetMask(), MaskDefault);
	Scene->SetToon(Objects[2], Make(0.5f, 0, 0.0f, 1.0f));
	EXPECT_EQ(GetMask(), MaskDefault & ~MASK_OUTSIDE_SPHERES);
	Scene->SetMask(Objects[2], MaskSunCasters);
	EXPECT_EQ(GetMask(), MaskSunCasters);
	Scene->SetMask(Objects[2], MaskDefault);
	Scene->SetToon(Objects[2], nullptr);
	EXPECT_EQ(GetMask(), MaskDefault);
}

} // namespace
} // namespace Lantern
