// Who casts shadows on whom: characters, and objects that shadow from the sun alone. By the reference, against light by formula.
#include <algorithm>
#include <cmath>
#include <numbers>

#include "Support/RenderFixture.h"
#include "Support/TestScene.h"

namespace Lantern
{

namespace
{
constexpr float Albedo = 0.5f;
constexpr double Lux = 4.0, Candela = 30.0;
constexpr double LampHeight = 2.5;

class FCasterTest : public FRenderTest
{
protected:
	/// A floor, two plates of one mesh at heights of 1 and 2 m, and a roof at 3 m over x > 0.
	void LoadPlates(const FRTObjectTraits& Plates, bool bRoof = true)
	{
		FTestScene Out("casters");
		const int32_t Grey = Out.AddLambert(glm::vec3(Albedo), glm::vec3(0), true);
		Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Grey, 8.0f)}));
		const int32_t Doll = Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Grey, 1.0f, 1.0f), FTestScene::MakeFloor(Grey, 1.0f, 2.0f)}));
		Out.Scene.Nodes[static_cast<size_t>(Doll)].Traits = Plates;
		if (bRoof) { Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Grey, 1.0f, 3.0f, {1, 0})})); }
		ASSERT_TRUE(Load(std::move(Out.Scene)));
		Lamp = {}; // it went with the scene before
		SetSky({});
	}
	/// Radiance of the upper side of what is at this height, at z = 0, by one light of its own.
	double Trace(double X, double Height)
	{
		return MeanGreen(TraceReference(LookAt({X, Height + 0.3, 3.0}, {X, Height, 0}, 0.0005f, 8, 8), 1, 1));
	}
	void UseSun()
	{
		SetSun(0.0, static_cast<float>(Lux), {0, -1, 0});
		if (Lamp.IsValid()) { GetScene().GetScene().RemoveLight(std::exchange(Lamp, {})); }
	}
	void UseLamp(double X)
	{
		SetSun(0.0, 0.0f);
		FSceneLight Light;
		Light.Position = {X, LampHeight, 0};
		Light.Color = glm::vec3(Candela);
		if (Lamp.IsValid()) { GetScene().GetScene().SetLight(Lamp, Light); }
		else { Lamp = GetScene().GetScene().AddLight(Light); }
	}
	static double LitBySun() { return Lux * Albedo / std::numbers::pi; }
	static double LitByLamp(double Height) { return Candela / std::pow(LampHeight - Height, 2.0) * Albedo / std::numbers::pi; }

	FLightId Lamp;
};

TEST_F(FCasterTest, ThingsShadowAllBelowThem)
{
	LoadPlates({});
	UseSun();
	EXPECT_NEAR(Trace(-0.5, 2.0), LitBySun(), 1e-3);
	EXPECT_EQ(Trace(-0.5, 1.0), 0.0);
	EXPECT_EQ(Trace(-0.5, 0.0), 0.0);
	UseLamp(-0.5);
	EXPECT_EQ(Trace(-0.5, 1.0), 0.0);
}

// Faces have no self-shadow; the floor has theirs, and they have that of the roof.
TEST_F(FCasterTest, CharactersShadowAllButCharacters)
{
	LoadPlates({.bCharacter = true});
	UseSun();
	EXPECT_NEAR(Trace(-0.5, 2.0), LitBySun(), 1e-3);
	EXPECT_NEAR(Trace(-0.5, 1.0), LitBySun(), 1e-3) << "no self-shadow";
	EXPECT_EQ(Trace(-0.5, 0.0), 0.0) << "casts on the floor";
	EXPECT_EQ(Trace(0.5, 1.0), 0.0) << "receives from the roof";
	UseLamp(-0.5);
	EXPECT_NEAR(Trace(-0.5, 1.0), LitByLamp(1.0), 2e-3 * LitByLamp(1.0));
	EXPECT_EQ(Trace(-0.5, 0.0), 0.0);
	// Without a shadow, it still has none of its own kind.
	LoadPlates({.bCastsShadow = false, .bCharacter = true});
	UseSun();
	EXPECT_NEAR(Trace(-0.5, 0.0), LitBySun(), 1e-3);
}

// Rays that look for the sky by the BRDF meet a character's other parts, which cast nothing on it: light sampling alone counts.
TEST_F(FCasterTest, CharactersSeeTheWholeSky)
{
	LoadPlates({.bCharacter = true}, false);
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(1));
	const FEstimate Lower = EstimateMean(LookAt({-0.5, 1.3, 3.0}, {-0.5, 1, 0}, 0.0005f, 32, 32), 16, 1);
	ExpectClosedForm("a character's lower plate under the sky", Lower, double(Albedo), 0.005);
	LoadPlates({}, false);
	SetSun(0.0, 0.0f);
	SetSky(glm::vec3(1));
	EXPECT_LT(EstimateMean(LookAt({-0.5, 1.3, 3.0}, {-0.5, 1, 0}, 0.0005f, 32, 32), 16, 1).Mean, 0.6 * double(Albedo));
}

// Signals know characters by the object that motion vectors name, filtered or not.
TEST_F(FCasterTest, SignalsLeaveCharactersWithoutSelfShadow)
{
	const auto Measure = [&](ESignal Signal, double X, double Height) {
		const FView View = LookAt({X, Height + 0.3, 3.0}, {X, Height, 0}, 0.0005f, 8, 8);
		const FImage Picture = RenderSignal(Signal, View);
		for (size_t I = 0; I < Picture.Pixels.size(); I += Picture.Channels)
		{
			EXPECT_EQ(Picture.Pixels[I] > 0.0f, Picture.Pixels[0] > 0.0f);
		}
		return MeanGreen(Picture) > 0.0;
	};
	for (const bool bCharacter : {true, false})
	{
		LoadPlates({.bCharacter = bCharacter});
		for (const char* const Path : {"1", "2"})
		{
			for (const char* const Filter : {"0", "1"})
			{
				SetVariable("r.RT.Shadow.Path", Path);
				SetVariable("r.RT.Shadow.Denoise", Filter);
				SetVariable("r.RT.Lights.Denoise", Filter);
				UseSun();
				EXPECT_TRUE(Measure(ESignal::SunShadow, -0.5, 2.0));
				EXPECT_EQ(Measure(ESignal::SunShadow, -0.5, 1.0), bCharacter) << "self-shadow";
				EXPECT_FALSE(Measure(ESignal::SunShadow, -0.5, 0.0)) << "casts on the floor";
				EXPECT_FALSE(Measure(ESignal::SunShadow, 0.5, 1.0)) << "receives from the roof";
				UseLamp(-0.5);
				EXPECT_EQ(Measure(ESignal::LocalDiffuse, -0.5, 1.0), bCharacter);
				EXPECT_FALSE(Measure(ESignal::LocalDiffuse, -0.5, 0.0));
			}
		}
	}
	LoadPlates({.bCharacter = true});
	UseSun();
	SetVariable("r.RT.Debug.Shadow.Receivers", "0");
	EXPECT_FALSE(Measure(ESignal::SunShadow, -0.5, 1.0)) << "the planted fault goes unnoticed";
}

TEST_F(FCasterTest, TreesMayShadowFromTheSunAlone)
{
	LoadPlates({.bCastsLocalShadow = false});
	UseSun();
	EXPECT_EQ(Trace(-0.5, 0.0), 0.0);
	UseLamp(-0.5);
	EXPECT_NEAR(Trace(-0.5, 0.0), LitByLamp(0.0), 2e-3 * LitByLamp(0.0));
	UseLamp(0.5);
	EXPECT_NEAR(Trace(0.5, 1.0), LitByLamp(1.0), 2e-3 * LitByLamp(1.0)) << "below the roof";
}

// The same in the signals: the sun's shadow is that of any other thing, and a lamp sees the floor.
TEST_F(FCasterTest, SignalsOfTreesThatShadowFromTheSunAlone)
{
	const auto Measure = [&](ESignal Signal) {
		return MeanGreen(RenderSignal(Signal, LookAt({-0.5, 0.3, 3.0}, {-0.5, 0, 0}, 0.0005f, 8, 8)));
	};
	SetVariable("r.RT.Lights.Denoise", "0");
	SetVariable("r.RT.Shadow.Denoise", "0");
	for (const char* const Path : {"1", "2"})
	{
		SetVariable("r.RT.Shadow.Path", Path);
		for (const bool bLocal : {true, false})
		{
			LoadPlates({.bCastsLocalShadow = bLocal});
			UseSun();
			EXPECT_EQ(Measure(ESignal::SunShadow), 0.0) << bLocal;
			UseLamp(-0.5);
			const double Lit = LitByLamp(0.0) / double(Albedo); // over the albedo
			EXPECT_NEAR(Measure(ESignal::LocalDiffuse), bLocal ? 0.0 : Lit, 0.005 * Lit) << bLocal;
		}
		SetVariable("r.RT.Debug.Lights.Casters", "0");
		EXPECT_EQ(Measure(ESignal::LocalDiffuse), 0.0) << "the planted fault goes unnoticed";
		SetVariable("r.RT.Debug.Lights.Casters", "1");
	}
}

// A plane of one side casts from a lamp as a shadow map with or without culling has it.
TEST_F(FCasterTest, FacesOfSingleSidedPlanesCastFromLamps)
{
	SetVariable("r.RT.Lights.Denoise", "0");
	for (const bool bTowards : {true, false})
	{
		FTestScene Out("faces");
		FTestScene::FQuad Plate = FTestScene::MakeFloor(Out.AddLambert(glm::vec3(Albedo)), 1.0f, 1.0f);
		if (!bTowards) { std::reverse(std::begin(Plate.P), std::end(Plate.P)); }
		Out.AddNode(Out.AddMesh({FTestScene::MakeFloor(Out.AddLambert(glm::vec3(Albedo), glm::vec3(0), true), 8.0f)}));
		Out.AddNode(Out.AddMesh({Plate}));
		ASSERT_TRUE(Load(std::move(Out.Scene)));
		Lamp = {};
		SetSky({});
		UseLamp(0.0);
		for (const char* const Path : {"1", "2"})
		{
			SetVariable("r.RT.Shadow.Path", Path);
			for (const int Faces : {0, 1, 2})
			{
				SetVariable("r.RT.Shadow.CasterFaces", std::to_string(Faces));
				const FImage Floor = RenderSignal(ESignal::LocalDiffuse, LookAt({0, 0.3, 3.0}, {0, 0, 0}, 0.0005f, 8, 8));
				const bool bCasts = Faces == 0 || (Faces == 1) == bTowards;
				EXPECT_EQ(MeanGreen(Floor) > 0.0, !bCasts) << "towards the lamp " << bTowards << ", faces " << Faces << ", path " << Path;
			}
		}
	}
}

TEST_F(FCasterTest, HiddenThingsCastShadows)
{
	LoadPlates({.bVisible = false});
	UseSun();
	EXPECT_EQ(Trace(-0.5, 0.0), 0.0);
	EXPECT_EQ(Trace(-0.5, 1.0), 0.0) << "the floor behind it is seen, and is dark";
}

TEST(FRTObjectTraitsTest, MasksSayWhoCastsOnWhom)
{
	EXPECT_EQ(MakeObjectMask({}) & MASK_CASTERS, MASK_SUN | MASK_LOCAL);
	EXPECT_EQ(MakeObjectMask({.bMoves = true}) & MASK_CASTERS, MASK_SUN_MOVING | MASK_LOCAL);
	EXPECT_EQ(MakeObjectMask({.bCastsLocalShadow = false, .bMoves = true}) & MASK_CASTERS, MASK_SUN_MOVING);
	EXPECT_EQ(MakeObjectMask({.bMoves = true, .bCharacter = true}) & MASK_CASTERS, MASK_CHARACTER);
	EXPECT_EQ(MakeObjectMask({.bCastsShadow = false, .bCharacter = true}) & MASK_CASTERS, 0u);
	EXPECT_EQ(MakeObjectMask({.bCastsLocalShadow = false, .bCharacter = true}) & MASK_CASTERS, MASK_CHARACTER) << "from all lights";
	EXPECT_EQ(MakeObjectMask({.bVisible = false}), MASK_SUN | MASK_LOCAL);
	EXPECT_EQ(MakeObjectMask({.bVisible = false, .bCastsShadow = false}), 0u);
	EXPECT_NE(MakeObjectMask({.bCastsShadow = false}) & MASK_VISIBLE, 0u);
}

} // namespace
} // namespace Lantern
