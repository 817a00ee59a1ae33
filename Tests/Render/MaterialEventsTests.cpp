// Materials that change what they emit or reflect: global illumination is told, and does not average over it.
#include "CachedGIFixture.h"

namespace Lantern
{

namespace
{
class FMaterialEventsTest : public FCachedGITest
{
protected:
	static constexpr uint32_t Settled = 96; // frames
	static constexpr float Emission = 50.0f;

	void SetUp() override
	{
		FSignalTest::SetUp();
		SetRoute("3");
		SetVariable("r.RT.GI.Denoise", "1");
		SetVariable("r.RT.GI.Rate", "2");
		SetVariable("r.RT.Lights.Emissive", "0"); // the sign lights by paths alone
	}

	/// A room with a sign on its wall, and another wall that nothing lights but the room.
	static FSceneDescription MakeSignRoom()
	{
		FTestScene Room("sign");
		const int32_t Wall = Room.AddLambert(glm::vec3(0.5f)), Sign = Room.AddLambert(glm::vec3(0.0f), glm::vec3(Emission));
		Room.AddNode(Room.AddMesh({FTestScene::MakeFloor(Wall, 3.0f), {Wall, {{-3, 0, -2}, {3, 0, -2}, {3, 3, -2}, {-3, 3, -2}}},
		    {Wall, {{3, 0, 2}, {-3, 0, 2}, {-3, 3, 2}, {3, 3, 2}}}}));
		Room.AddNode(Room.AddMesh({{Sign, {{-0.5, 1.5, -1.95}, {0.5, 1.5, -1.95}, {0.5, 2, -1.95}, {-0.5, 2, -1.95}}}}));
		return std::move(Room.Scene);
	}
	void SetEmission(float Value)
	{
		FRTScene& Scene = GetScene().GetScene();
		for (uint32_t Index = 0; Index < Scene.GetMaterials().Num(); ++Index)
		{
			FMaterialData Material = Scene.GetMaterials()[Index];
			if (Material.BaseColor.x > 0.0f) { continue; }
			Material.Emissive = Material.LightEmissive = glm::vec3(Value);
			Material.EmissiveWeight = Value / 64.0f; // as hosts do
			Scene.SetMaterial(Index, Material);
		}
	}
	/// Light of the room in frames First to First + Count − 1.
	double FindLight(const FView& View, uint32_t First, uint32_t Count)
	{
		return MeanGreen(RenderSignal(ESignal::DiffuseGI, View, Count, First));
	}
};

// Limits are those of a light that is switched (Docs/Stability.md, case 4), for light of one bounce.
TEST_F(FMaterialEventsTest, SignThatIsSwitched)
{
	const FView View = LookAt({2.5, 1.6, 1.5}, {-1, 0.8, -1}, 1.0f, 64, 48);
	double Rises[2], Rests[2];
	for (const bool bTold : {true, false})
	{
		ASSERT_TRUE(Load(MakeSignRoom()));
		SetVariable("r.RT.Debug.GI.Events", bTold ? "1" : "0");
		FindLight(View, 0, Settled);
		const double Lit = FindLight(View, Settled, 16);
		SetEmission(0.001f * Emission); // where nothing shines at all, nothing is traced
		FindLight(View, Settled + 16, 14);
		const double Dark = FindLight(View, Settled + 30, 4);
		FindLight(View, Settled + 34, 60);
		Rests[bTold] = FindLight(View, Settled + 94, 2) / Lit;
		SetEmission(Emission);
		FindLight(View, Settled + 96, 14);
		Rises[bTold] = FindLight(View, Settled + 110, 4) / Lit;
		PrintFigure(fmt::format("sign, told {}: light {:.3f}; behind 16 frames off {:.4f} of it, behind 76 {:.5f}; behind 16 on {:.4f}",
		    bTold, Lit, Dark / Lit, Rests[bTold], Rises[bTold]));
		if (bTold) { EXPECT_LT(Dark / Lit, 0.1); }
		else { EXPECT_GT(Dark / Lit, 0.1) << "the planted fault must be seen"; }
	}
	EXPECT_LT(Rests[true], 0.01);
	EXPECT_GT(Rises[true], 0.9);
	EXPECT_LT(Rises[false], 0.9) << "the planted fault must be seen";
}

} // namespace
} // namespace Lantern
