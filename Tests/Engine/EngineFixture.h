// A module, a raster with conventions of its own, and scenes of triangles, for tests of what an engine hands over.
#pragma once

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "EngineRaster.h"
#include "LanternHost/SceneLoader.h"
#include "Support/StatusChecks.h"

namespace Lantern
{

/// What the truth says of the pixels of a frame.
struct FVerdict
{
	size_t Pixels = 0; ///< that show a surface of which the truth is certain
	size_t Lit = 0, FalselyDark = 0, FalselyLit = 0;
	double GetDarkShare() const { return Lit > 0 ? double(FalselyDark) / double(Lit) : 1.0; }
	double GetLitShare() const { return Pixels > Lit ? double(FalselyLit) / double(Pixels - Lit) : 0.0; }
};

class FConventionTest : public testing::Test
{
protected:
	static constexpr glm::uvec2 Size{480, 270};
	const glm::dvec3 ToSun = glm::normalize(glm::dvec3(-0.25, 1.0, -0.35));

	void SetUp() override
	{
		ASSERT_EQ(LanternCreateModule(ModuleVersion, Module.ReleaseAndGetAddress()), 0);
		FRTModuleDesc Desc;
		Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
		Desc.CacheFolder = LANTERN_TEST_CACHE;
		ASSERT_OK(Module->Initialize(Desc));
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Pipeline.Fallback", "2"));
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Build.TrianglesPerFrame", "100000000"));
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Shadow.Soft", "0"));
		ASSERT_OK(Module->SetConsoleVariable("r.RT.Culling", "0"));
		ASSERT_OK(OpenDevice());
	}
	virtual FRTStatus OpenDevice() { return Module->CreateDevice(true, Device.ReleaseAndGetAddress()); }
	void TearDown() override
	{
		Raster.reset();
		Renderer.Reset();
		if (Device)
		{
			EXPECT_TRUE(Device->WaitIdle().IsOk());
			if (bCountsMessages) { EXPECT_EQ(Device->GetValidationMessageCount(), 0u); }
		}
		Device.Reset();
		Module.Reset();
	}
	void LoadSoup(const std::string& Name)
	{
		FLoadResult Result = LoadScene(Name);
		ASSERT_TRUE(Result.Scene.has_value()) << Result.Error;
		Soup = MakeSoup(*Result.Scene);
		SetCamera(*Result.Scene);
	}
	void SetCamera(const FSceneDescription& Scene)
	{
		const FScenePose Pose = EvaluatePose(Scene, 0.0);
		for (size_t Node = 0; Node < Scene.Nodes.size(); ++Node)
		{
			if (Scene.Nodes[Node].Camera < 0) { continue; }
			Camera.Position = glm::dvec3(Pose.World[Node][3]);
			Camera.Forward = -glm::normalize(glm::dvec3(Pose.World[Node][2]));
			Camera.Up = glm::normalize(glm::dvec3(Pose.World[Node][1]));
			Camera.FovY = Scene.Cameras[static_cast<size_t>(Scene.Nodes[Node].Camera)].FovY;
			return;
		}
	}
	/// Gives the triangles to the plugin and to the raster. World: of the engine, in which it then has them.
	void Open(const FRTModuleRendererDesc& World = {})
	{
		ASSERT_OK(Module->CreateRenderer(Device.Get(), World, Renderer.ReleaseAndGetAddress()));
		Raster = std::make_unique<FEngineRaster>(*Device);
		ASSERT_OK(Raster->SetScene(Soup));
		Truth = std::make_unique<FTriangleTruth>(Soup);
		std::vector<uint32_t> Indices(Soup.Positions.size());
		for (uint32_t I = 0; I < Indices.size(); ++I) { Indices[I] = I; }
		FRTModuleMesh Mesh;
		Mesh.Name = "Soup";
		Mesh.Positions = &Soup.Positions[0].x;
		Mesh.VertexCount = static_cast<uint32_t>(Soup.Positions.size());
		Mesh.Indices = Indices.data();
		Mesh.IndexCount = static_cast<uint32_t>(Indices.size());
		ERTMeshHandle Handle = ERTMeshHandle::None;
		ERTMaterialHandle White = ERTMaterialHandle::None;
		FRTModuleMaterial Material;
		Material.bDoubleSided = true;
		ASSERT_OK(Renderer->AddMaterial(Material, &White));
		ASSERT_OK(Renderer->AddMesh(Mesh, &Handle));
		FRTModuleObject Placed;
		Placed.Mesh = Handle;
		Placed.Materials = &White;
		Placed.MaterialCount = 1;
		Placed.bCastsShadow = bCastsShadow;
		PlaceInWorld(World, Placed.Transform);
		ASSERT_OK(Renderer->AddObject(Placed, &Object));
		FRTModuleSun Sun;
		const glm::dvec3 Travel = ToEngine(World, -ToSun);
		for (int Axis = 0; Axis < 3; ++Axis) { Sun.Direction[Axis] = Travel[Axis]; }
		Sun.Irradiance = 1.0f;
		ASSERT_OK(Renderer->SetSun(Sun));
	}
	/// A direction of Lantern's world in the engine's.
	static glm::dvec3 ToEngine(const FRTModuleRendererDesc& World, const glm::dvec3& V)
	{
		const auto Dot = [&](const float A[3]) { return A[0] * V.x + A[1] * V.y + A[2] * V.z; };
		return {Dot(World.AxisX), Dot(World.AxisY), Dot(World.AxisZ)};
	}
	static void PlaceInWorld(const FRTModuleRendererDesc& World, double Transform[12])
	{
		for (int Column = 0; Column < 3; ++Column)
		{
			glm::dvec3 Axis(0);
			Axis[Column] = 1.0 / double(World.MetersPerUnit);
			const glm::dvec3 Placed = ToEngine(World, Axis);
			for (int Row = 0; Row < 3; ++Row) { Transform[Row * 4 + Column] = Placed[Row]; }
		}
	}
	FVerdict Judge(const FEngineConventions& As, const std::vector<float>& Visibility, const std::vector<uint32_t>& Triangles) const
	{
		FVerdict Out;
		for (size_t Pixel = 0; Pixel < Triangles.size(); ++Pixel)
		{
			if (Triangles[Pixel] == 0) { continue; }
			glm::dvec3 Origin, Direction;
			FEngineRaster::MakeRay(Camera, As, Size, {double(Pixel % Size.x) + 0.5, double(Pixel / Size.x) + 0.5}, Origin, Direction);
			const uint32_t Triangle = Triangles[Pixel] - 1;
			const FTriangleTruth::FPlanePoint Point = Truth->MeetPlane(Triangle, Origin, Direction);
			// The raster's grid has let the pixel show a triangle beside its own.
			if (!Point.bInside) { continue; }
			const bool bLit = glm::dot(Point.Normal, ToSun) > 0.0 && !(bCastsShadow && Truth->IsBlocked(Point.Point, ToSun, Triangle));
			const bool bShownLit = Visibility[Pixel] > 0.5f;
			++Out.Pixels;
			Out.Lit += bLit ? 1 : 0;
			Out.FalselyDark += bLit && !bShownLit ? 1 : 0;
			Out.FalselyLit += !bLit && bShownLit ? 1 : 0;
		}
		return Out;
	}
	FVerdict RenderAndJudge(const FEngineConventions& As)
	{
		std::vector<float> Visibility;
		std::vector<uint32_t> Triangles;
		for (int Frame = 0; Frame < 8; ++Frame)
		{
			const FRTStatus Status = Raster->Render(*Renderer, Camera, As, Size, Visibility, Triangles);
			EXPECT_TRUE(Status.IsOk()) << As.Name << ": " << Status.Message;
			if (!Status || Raster->IsComplete()) { break; }
		}
		EXPECT_TRUE(Raster->IsComplete()) << As.Name;
		const FVerdict Verdict = Judge(As, Visibility, Triangles);
		std::printf("[  figure  ] %s\n",
		    fmt::format("{}: {} pixels, {} lit; falsely dark {:.4f} % ({}), falsely lit {:.4f} % ({})", As.Name, Verdict.Pixels,
		        Verdict.Lit, 100 * Verdict.GetDarkShare(), Verdict.FalselyDark, 100 * Verdict.GetLitShare(), Verdict.FalselyLit)
		        .c_str());
		return Verdict;
	}
	/// The table of what ordinary engines have.
	void CheckTable(size_t LeastLit)
	{
		const FEngineConventions Rows[] = {{}, {.Name = "jitter of 0.45 pixels", .Jitter = {0.45f, -0.45f}},
		    {.Name = "finite D32S8, near 0.5, far 1024",
		        .DepthFormat = ERTFormat::D32_FLOAT_S8_UINT,
		        .bReversed = false,
		        .Near = 0.5,
		        .Far = 1024},
		    {.Name = "finite D32S8, near 0.1, far 1024",
		        .DepthFormat = ERTFormat::D32_FLOAT_S8_UINT,
		        .bReversed = false,
		        .Near = 0.1,
		        .Far = 1024},
		    {.Name = "one view-space UNORM8 normal", .Normals = EEngineNormals::View},
		    {.Name = "all of it",
		        .DepthFormat = ERTFormat::D32_FLOAT_S8_UINT,
		        .bReversed = false,
		        .Near = 0.1,
		        .Far = 1024,
		        .Jitter = {-0.45f, 0.45f},
		        .Normals = EEngineNormals::View}};
		for (const FEngineConventions& Row : Rows)
		{
			const FVerdict Verdict = RenderAndJudge(Row);
			EXPECT_GE(Verdict.Lit, LeastLit) << Row.Name;
			EXPECT_LE(Verdict.GetDarkShare(), 0.0005) << Row.Name;
			// Without a geometric normal, rays that graze the back of a leaf may pass it.
			EXPECT_LE(Verdict.GetLitShare(), Row.Normals == EEngineNormals::View ? 0.005 : 0.0005) << Row.Name;
		}
	}

	bool bCountsMessages = true, bCastsShadow = true;
	ERTObjectHandle Object = ERTObjectHandle::None;
	TRTRef<IRTModule> Module;
	TRTRef<IRTDevice> Device;
	TRTRef<IRTModuleRenderer> Renderer;
	FTriangleSoup Soup;
	FEngineCamera Camera;
	std::unique_ptr<FTriangleTruth> Truth;
	std::unique_ptr<FEngineRaster> Raster;
};

/// Boxes over a floor: a few triangles.
inline FTriangleSoup MakeBoxes()
{
	FTriangleSoup Soup;
	const auto AddBox = [&](const glm::vec3& Center, const glm::vec3& Half) {
		for (int Face = 0; Face < 6; ++Face)
		{
			const int Axis = Face / 2;
			glm::vec3 N(0), U(0), V(0);
			N[Axis] = Face % 2 ? 1.0f : -1.0f;
			U[(Axis + 1) % 3] = 1.0f;
			V = glm::cross(N, U);
			const auto Corner = [&](float A, float B) { return Center + (N + U * A + V * B) * Half; };
			for (const glm::vec2 At : {glm::vec2(-1, -1), {1, -1}, {1, 1}, {-1, -1}, {1, 1}, {-1, 1}})
			{
				Soup.Positions.push_back(Corner(At.x, At.y));
				Soup.Normals.push_back(N);
			}
		}
	};
	AddBox({0, -0.5f, 0}, {40, 0.5f, 40});
	for (int I = 0; I < 30; ++I)
	{
		const float X = float(I * 7 % 11) * 1.7f - 9.0f, Z = float(I * 5 % 13) * 1.6f - 11.0f, Height = 0.2f + 0.13f * float(I % 9);
		AddBox({X, Height, Z}, {0.15f + 0.05f * float(I % 5), Height, 0.4f});
	}
	return Soup;
}

class FBoxesTest : public FConventionTest
{
protected:
	void SetUp() override
	{
		FConventionTest::SetUp();
		Soup = MakeBoxes();
		Camera = {{3, 4, 12}, glm::normalize(glm::dvec3(-0.3, -0.35, -1)), {0, 1, 0}, 1.0};
	}
	std::vector<float> RenderPicture(const FEngineConventions& As)
	{
		std::vector<float> Visibility;
		std::vector<uint32_t> Triangles;
		for (int Frame = 0; Frame < 4; ++Frame)
		{
			const FRTStatus Status = Raster->Render(*Renderer, Camera, As, Size, Visibility, Triangles);
			EXPECT_TRUE(Status.IsOk()) << Status.Message;
		}
		return Visibility;
	}
	static double CountDifferent(const std::vector<float>& A, const std::vector<float>& B)
	{
		EXPECT_EQ(A.size(), B.size());
		size_t Different = 0;
		for (size_t I = 0; I < std::min(A.size(), B.size()); ++I) { Different += A[I] != B[I] ? 1 : 0; }
		return double(Different) / double(A.size());
	}
};

} // namespace Lantern
