// The sky as a texture of the engine's: pictures are those of the same sky said otherwise.
#include <cmath>
#include <cstring>
#include <fstream>

#include <fmt/format.h>
#include <glm/gtc/packing.hpp>

#include "FlatEngine.h"
#include "Support/OctahedralTexels.h"
#include "Support/SharedFiles.h"

namespace Lantern
{
namespace
{

constexpr glm::vec3 Uniform{0.5f, 0.75f, 1.25f};

/// A sky that grows brighter towards +x: E(n) / π of it is a + 2/3 b n.x.
constexpr float Mean = 0.75f, Slope = 0.5f;
glm::vec3 GetSlopedSky(glm::vec3 Direction) { return glm::vec3(Mean + Slope * Direction.x); }

class FSkyMapTest : public FFlatEngineTest
{
protected:
	static constexpr FSignalSet Wanted{ESignal::DiffuseGI, ESignal::Reflections};
	static constexpr uint32_t FaceSize = 32, OctahedralSize = 64;

	void SetUp() override
	{
		FFlatEngineTest::SetUp();
		SetVariable("r.RT.GI.Samples", "16");
		FRTSamplerDesc Desc;
		Desc.U = Desc.V = ERTAddress::Clamp;
		ASSERT_OK(Device->CreateSampler(Desc, Sampler.ReleaseAndGetAddress()));
	}
	void TearDown() override
	{
		Sampler.Reset();
		Maps.clear();
		FFlatEngineTest::TearDown();
	}
	template <class FGet>
	IRTTexture* MakeCube(FGet GetRadiance)
	{
		// Face, s to the right and t downwards, as Vulkan's table of cube map faces has them.
		const auto GetDirection = [](int Face, float S, float T) -> glm::vec3 {
			switch (Face)
			{
			case 0: return {1, -T, -S};
			case 1: return {-1, -T, S};
			case 2: return {S, 1, T};
			case 3: return {S, -1, -T};
			case 4: return {S, -T, 1};
			default: return {-S, -T, -1};
			}
		};
		std::vector<glm::vec4> Texels;
		for (int Face = 0; Face < 6; ++Face)
		{
			for (uint32_t Texel = 0; Texel < FaceSize * FaceSize; ++Texel)
			{
				const glm::vec2 Place = (glm::vec2(Texel % FaceSize, Texel / FaceSize) + 0.5f) * (2.0f / FaceSize) - 1.0f;
				Texels.emplace_back(GetRadiance(glm::normalize(GetDirection(Face, Place.x, Place.y))), 1.0f);
			}
		}
		FRTTextureDesc Desc{FaceSize, FaceSize, 1, 6, ERTFormat::RGBA32_FLOAT, ERTTextureUsage::Sampled, "SkyCube"};
		Desc.bCube = true;
		return Maps.emplace_back(MakeTexture(Desc, Texels.data())).Get();
	}
	template <class FGet>
	IRTTexture* MakeOctahedral(FGet GetRadiance)
	{
		const std::vector<glm::vec4> Texels = MakeOctahedralTexels(OctahedralSize, GetRadiance);
		const FRTTextureDesc Desc{OctahedralSize, OctahedralSize, 1, 1, ERTFormat::RGBA32_FLOAT, ERTTextureUsage::Sampled, "SkyMap"};
		return Maps.emplace_back(MakeTexture(Desc, Texels.data())).Get();
	}
	FRTModuleSkyMap Describe(IRTTexture* Texture, float Intensity = 1.0f) const
	{
		FRTModuleSkyMap Map;
		Map.Texture = Texture;
		Map.Sampler = Sampler.Get();
		Map.Kind = Texture->GetDesc().bCube ? ERTModuleSkyMap::Cube : ERTModuleSkyMap::Octahedral;
		Map.Intensity = Intensity;
		return Map;
	}
	/// A box hides part of the sky.
	void FillWorld(IRTModuleRenderer& Renderer)
	{
		FRTModuleMaterial Desc;
		Desc.bDoubleSided = true;
		ERTMaterialHandle White = ERTMaterialHandle::None;
		ASSERT_OK(Renderer.AddMaterial(Desc, &White));
		Place(Renderer, AddSquare(Renderer, 1.0f, 0.0f), White, {-1.0, 0.5, 0.5}, 0.7);
	}
	FSignalPicture RenderSky(const FRTModuleSkyMap* Map, glm::vec3 Radiance = glm::vec3(0))
	{
		return Render(
		    [&](IRTModuleRenderer& Renderer) {
			FillWorld(Renderer);
			ASSERT_OK(Renderer.SetSky(&Radiance.x));
			ASSERT_OK(Renderer.SetSkyMap(Map));
		    },
		    Wanted);
	}
	static void Print(const char* What, double Difference)
	{
		std::printf("[  figure  ] %s\n", fmt::format("{}: mean difference {:.2e}", What, Difference).c_str());
	}

	TRTRef<IRTSampler> Sampler;
	std::vector<TRTRef<IRTTexture>> Maps;
};

TEST_F(FSkyMapTest, AUniformMapGivesThePictureOfAUniformSky)
{
	const auto GetUniform = [](glm::vec3) { return 0.25f * Uniform; };
	const FSignalPicture Said = RenderSky(nullptr, Uniform);
	EXPECT_GT(Said.GetMean(ESignal::DiffuseGI), 0.1);
	const FRTModuleSkyMap Cube = Describe(MakeCube(GetUniform), 4.0f), Octahedral = Describe(MakeOctahedral(GetUniform), 4.0f);
	// Filtering of equal texels may round; outputs have 11 bits.
	constexpr double Tolerance = 1e-3;
	for (const FRTModuleSkyMap* const Map : {&Cube, &Octahedral})
	{
		const double Difference = Said.GetMeanDifference(RenderSky(Map, {9, 9, 9}));
		Print("uniform", Difference);
		EXPECT_LE(Difference, Tolerance);
	}
}

TEST_F(FSkyMapTest, ARotatedMapTurnsTheSky)
{
	const FRTModuleSkyMap Cube = Describe(MakeCube(GetSlopedSky)), Octahedral = Describe(MakeOctahedral(GetSlopedSky));
	const FSignalPicture Straight = RenderSky(&Cube);
	// A linear function of direction is not linear between texels: faces of 32 are off by less than a thousandth.
	const double Kinds = Straight.GetMeanDifference(RenderSky(&Octahedral));
	Print("cube and octahedral map", Kinds);
	EXPECT_LE(Kinds, 2e-3);
	FRTModuleSkyMap Turned = Cube;
	constexpr float HalfTurn[9] = {-1, 0, 0, 0, 1, 0, 0, 0, -1};
	std::copy(std::begin(HalfTurn), std::end(HalfTurn), Turned.WorldToMap);
	const FSignalPicture Rotated = RenderSky(&Turned);
	Print("rotated", Straight.GetMeanDifference(Rotated));
	EXPECT_GT(Straight.GetMeanDifference(Rotated), 0.05)
	    << "the bright side is another: reflections see it, and light of a whole half does not";
	// A map painted the other way round is the same sky.
	const auto GetTurned = [](glm::vec3 Direction) { return GetSlopedSky({-Direction.x, Direction.y, -Direction.z}); };
	const FRTModuleSkyMap Other = Describe(MakeCube(GetTurned));
	const double Painted = Rotated.GetMeanDifference(RenderSky(&Other));
	Print("rotated and painted so", Painted);
	EXPECT_LE(Painted, 1e-3);
}

TEST_F(FSkyMapTest, AProgramIsTheSkyThatAMapOfItIs)
{
	const FRTModuleSkyMap Cube = Describe(MakeCube(GetSlopedSky));
	const FSignalPicture Mapped = RenderSky(&Cube);
	const FTemporaryFolder Folder;
	const std::string File = Folder / "OwnSky.glsl";
	std::ofstream(File)
	    << "vec3 EvaluateSky(vec3 Direction, FSkyData Sky) { return vec3(Sky.Values[0].x + Sky.Values[15].w * Direction.x); }";
	RendererDesc.SkyShader = File.c_str();
	FRTModuleSkyProgram Program;
	Program.Values[0] = Mean;
	Program.Values[63] = Slope;
	BeforeFrame = [&](IRTModuleRenderer& Renderer, int) { ASSERT_OK(Renderer.SetSkyProgram(&Program)); };
	for (const char* const Bake : {"1", "0"})
	{
		SetVariable("r.RT.Sky.Bake", Bake);
		const double Difference = Mapped.GetMeanDifference(RenderSky(nullptr, Uniform));
		Print(*Bake == '1' ? "baked" : "in place", Difference);
		EXPECT_LE(Difference, 2e-3) << "as of two kinds of maps";
	}
	BeforeFrame = [&](IRTModuleRenderer& Renderer, int Index) { ASSERT_OK(Renderer.SetSkyProgram(Index < 3 ? &Program : nullptr)); };
	EXPECT_EQ(Mapped.GetMeanDifference(RenderSky(&Cube)), 0.0) << "null: the map again";
}

TEST_F(FSkyMapTest, ASkyMayChangeEachFrame)
{
	const FRTModuleSkyMap Cube = Describe(MakeCube(GetSlopedSky)), Octahedral = Describe(MakeOctahedral(GetSlopedSky));
	const FSignalPicture Steady = RenderSky(&Cube);
	BeforeFrame = [&](IRTModuleRenderer& Renderer, int Index) {
		const FRTModuleSkyMap* const Turns[] = {&Octahedral, nullptr, &Cube};
		ASSERT_OK(Renderer.SetSkyMap(Turns[Index % 3]));
	};
	const FSignalPicture Changed = RenderSky(nullptr, Uniform);
	EXPECT_EQ(Steady.GetMeanDifference(Changed), 0.0) << "the sixth frame has the cube";
	BeforeFrame = nullptr;
	const FSignalPicture Plain = RenderSky(nullptr, Uniform);
	BeforeFrame = [&](IRTModuleRenderer& Renderer, int Index) { ASSERT_OK(Renderer.SetSkyMap(Index < 5 ? &Cube : nullptr)); };
	EXPECT_EQ(Plain.GetMeanDifference(RenderSky(nullptr, Uniform)), 0.0) << "null: the radiance again";
}

} // namespace
} // namespace Lantern
