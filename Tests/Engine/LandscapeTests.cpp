// Landscapes of patches: rays see what a plain mesh of the same heights shows them, and nothing between the patches.
#include <cmath>

#include <fmt/format.h>

#include "FlatEngine.h"

namespace Lantern
{
namespace
{

class FLandscapeTest : public FFlatEngineTest
{
protected:
	static constexpr FSignalSet Wanted{ESignal::SunShadow, ESignal::DiffuseGI, ESignal::Reflections};
	static constexpr uint32_t Quads = 8, Side = 2; ///< along a patch, and patches along the landscape
	static constexpr float Spacing = 0.35f, Scale = 1.0f / 65536, Offset = 0.3f;
	/// Where the landscape begins: its middle lies at the centre of a pixel, so that many rays end where patches meet.
	static constexpr double First = 2.0 / Size - Quads * double(Spacing);

	/// A wave that is straight around the border of two patches: the slope from one side is there that of the whole.
	template <typename FWave>
	static double GetWave(uint32_t Place, const FWave& Wave)
	{
		return Place == Quads ? 0.5 * (Wave(Place - 1.0) + Wave(Place + 1.0)) : Wave(double(Place));
	}
	static uint16_t GetHeight(uint32_t Column, uint32_t Row)
	{
		const double Wide = GetWave(Column, [](double At) { return std::sin(0.9 * At); });
		const double Deep = GetWave(Row, [](double At) { return std::cos(0.7 * At); });
		return static_cast<uint16_t>(30000.0 + 20000.0 * Wide * Deep);
	}
	/// z of the object points upwards, y away from the viewer's top.
	static void PlaceUpright(IRTModuleRenderer& Renderer, ERTMeshHandle Mesh, ERTMaterialHandle Material, double X, double Y)
	{
		FRTModuleObject Object;
		Object.Mesh = Mesh;
		Object.Materials = &Material;
		Object.MaterialCount = 1;
		const double Transform[12] = {1, 0, 0, First + X, 0, 0, 1, 0, 0, -1, 0, -First - Y};
		std::copy(std::begin(Transform), std::end(Transform), Object.Transform);
		ERTObjectHandle Out = ERTObjectHandle::None;
		ASSERT_OK(Renderer.AddObject(Object, &Out));
	}
	static void AddLight(IRTModuleRenderer& Renderer, double SunX)
	{
		FRTModuleSun Sun;
		Sun.Direction[0] = SunX;
		Sun.Irradiance = 3.0f;
		const float Sky[3] = {0.5f, 0.7f, 1.0f};
		ASSERT_OK(Renderer.SetSun(Sun));
		ASSERT_OK(Renderer.SetSky(Sky));
	}
	float Emission = 0.0f; ///< of the ground, in the green channel
	ERTMaterialHandle AddGround(IRTModuleRenderer& Renderer) const
	{
		FRTModuleMaterial Desc;
		Desc.bDoubleSided = true;
		Desc.Emissive[1] = Emission;
		ERTMaterialHandle Out = ERTMaterialHandle::None;
		EXPECT_TRUE(Renderer.AddMaterial(Desc, &Out).IsOk());
		return Out;
	}
	FSignalPicture RenderPatches(double SunX, const uint8_t* Holes = nullptr)
	{
		return Render(
		    [&](IRTModuleRenderer& Renderer) {
			const ERTMaterialHandle Ground = AddGround(Renderer);
			AddLight(Renderer, SunX);
			for (uint32_t Index = 0; Index < Side * Side; ++Index)
			{
				const uint32_t X = Index % Side, Y = Index / Side;
				std::vector<uint16_t> Heights;
				for (uint32_t I = 0; I < (Quads + 1) * (Quads + 1); ++I)
				{
					Heights.push_back(GetHeight(X * Quads + I % (Quads + 1), Y * Quads + I / (Quads + 1)));
				}
				FRTModuleLandscape Patch;
				Patch.Heights = Heights.data();
				Patch.Columns = Patch.Rows = Quads + 1;
				Patch.SpacingX = Patch.SpacingY = Spacing;
				Patch.HeightScale = Scale;
				Patch.HeightOffset = Offset;
				Patch.Holes = Index == 0 ? Holes : nullptr;
				ERTMeshHandle Mesh = ERTMeshHandle::None;
				ASSERT_OK(Renderer.AddLandscape(Patch, &Mesh));
				PlaceUpright(Renderer, Mesh, Ground, X * Quads * double(Spacing), Y * Quads * double(Spacing));
			}
		    },
		    Wanted);
	}
	FSignalPicture RenderPlain(double SunX)
	{
		return Render(
		    [&](IRTModuleRenderer& Renderer) {
			constexpr uint32_t Count = Side * Quads + 1;
			std::vector<glm::vec3> Positions;
			std::vector<uint32_t> Indices;
			for (uint32_t I = 0; I < Count * Count; ++I)
			{
				const uint32_t Column = I % Count, Row = I / Count;
				Positions.emplace_back(Column * Spacing, Row * Spacing, Offset + Scale * float(GetHeight(Column, Row)));
				if (Column + 1 == Count || Row + 1 == Count) { continue; }
				Indices.insert(Indices.end(), {I, I + 1, I + Count + 1, I, I + Count + 1, I + Count});
			}
			std::vector<glm::vec3> Slopes;
			const auto GetZ = [&](uint32_t Column, uint32_t Row) { return double(Positions[Row * Count + Column].z); };
			for (uint32_t I = 0; I < Count * Count; ++I)
			{
				const uint32_t Column = I % Count, Row = I / Count;
				const uint32_t Left = Column > 0 ? Column - 1 : 0, Right = std::min(Column + 1, Count - 1);
				const uint32_t Above = Row > 0 ? Row - 1 : 0, Below = std::min(Row + 1, Count - 1);
				Slopes.emplace_back(glm::normalize(glm::dvec3((GetZ(Left, Row) - GetZ(Right, Row)) / (Right - Left) / double(Spacing),
				    (GetZ(Column, Above) - GetZ(Column, Below)) / (Below - Above) / double(Spacing), 1.0)));
			}
			FRTModuleMesh Mesh;
			Mesh.Positions = &Positions[0].x;
			Mesh.Normals = &Slopes[0].x;
			Mesh.VertexCount = static_cast<uint32_t>(Positions.size());
			Mesh.Indices = Indices.data();
			Mesh.IndexCount = static_cast<uint32_t>(Indices.size());
			Mesh.bKeepOnCpu = false;
			ERTMeshHandle Handle = ERTMeshHandle::None;
			const ERTMaterialHandle Ground = AddGround(Renderer);
			AddLight(Renderer, SunX);
			ASSERT_OK(Renderer.AddMesh(Mesh, &Handle));
			PlaceUpright(Renderer, Handle, Ground, 0, 0);
		    },
		    Wanted);
	}
};

TEST_F(FLandscapeTest, PicturesAreThoseOfAPlainMesh)
{
	const FSignalPicture Plain = RenderPlain(0.4), Patches = RenderPatches(0.4);
	for (const ESignal Signal : {ESignal::DiffuseGI, ESignal::Reflections}) { EXPECT_GT(Plain.GetMean(Signal), 0.01); }
	const double Difference = Plain.GetMeanDifference(Patches);
	std::printf("[  figure  ] %s\n", fmt::format("patches and a plain mesh: mean difference {:.2e}", Difference).c_str());
	// Rounding of transforms moves hits by some 1e-7 m.
	EXPECT_LE(Difference, 1e-4);
}

TEST_F(FLandscapeTest, EmissivePatchesShineAsAPlainMesh)
{
	const double Dark = RenderPlain(0.4).GetMean(ESignal::DiffuseGI);
	Emission = 0.3f;
	const double Plain = RenderPlain(0.4).GetMean(ESignal::DiffuseGI), Patches = RenderPatches(0.4).GetMean(ESignal::DiffuseGI);
	std::printf("[  figure  ] %s\n", fmt::format("dark {:.4f}, plain mesh {:.4f}, patches {:.4f}", Dark, Plain, Patches).c_str());
	EXPECT_GT(Plain, 1.1 * Dark);
	// Rays choose emissive triangles by their place in the list, which differs: one path to a pixel leaves that much noise.
	EXPECT_NEAR(Patches, Plain, 0.05 * (Plain - Dark));
}

TEST_F(FLandscapeTest, NoRayPassesBetweenPatches)
{
	const FSignalPicture Closed = RenderPatches(0.0);
	EXPECT_EQ(Closed.GetMean(ESignal::SunShadow), 0.0) << "the landscape hides the sun from all of the floor";
	uint8_t Holes[Quads * Quads] = {};
	Holes[Quads * Quads - 1] = 1;
	const double Lit = RenderPatches(0.0, Holes).GetMean(ESignal::SunShadow);
	const double Expected = double(Spacing) * double(Spacing) / 16.0; // of the floor's 4 m × 4 m
	EXPECT_NEAR(Lit, Expected, 0.3 * Expected) << "a hole lets through what is as wide as it is";
}

} // namespace
} // namespace Lantern
