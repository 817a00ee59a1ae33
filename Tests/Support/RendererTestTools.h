// For the tests of LanternRenderer: the sample engine on a mock device behind the validation wrapper, and scenes that
// have just what a test asks for.
#pragma once

#include <algorithm>
#include <memory>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternCore/Config/ConsoleVariables.h"
#include "LanternHost/SampleEngine.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternRHIValidation/ValidationDevice.h"

namespace Lantern
{

struct FContent
{
	bool bObjects = true;
	bool bMasked = false;
	bool bSkinned = false;
	bool bLights = false;
	bool bTexture = false;
	bool bEmissive = false;
	bool bSun = true;
	bool bSky = false;
	bool bGlass = false;
};

inline FHostMesh MakeQuad(const char* Name, int32_t Material, bool bSkinned)
{
	FHostMesh Mesh;
	Mesh.Name = Name;
	Mesh.Positions = {{-1, -1, 0}, {1, -1, 0}, {1, 1, 0}, {-1, 1, 0}};
	Mesh.Attributes.resize(4);
	Mesh.Indices = {0, 1, 2, 0, 2, 3};
	Mesh.Sections = {{0, 6, Material}};
	Mesh.BoundsMin = {-1, -1, 0};
	Mesh.BoundsMax = {1, 1, 0};
	if (bSkinned) { Mesh.Skin.resize(4, FSkinWeights{{0, 0, 0, 0}, {1, 0, 0, 0}}); }
	return Mesh;
}

/// Quads at the origin, in the plane z = 0: a plain one and those that the content asks for.
inline FSceneDescription MakeDescription(const FContent& Content)
{
	FSceneDescription Scene;
	Scene.Name = "Test";
	Scene.Materials.resize(1);
	const auto AddQuad = [&](const char* Name, int32_t Material, bool bSkinned) {
		FHostNode Node;
		Node.Name = Name;
		Node.Mesh = static_cast<int32_t>(Scene.Meshes.size());
		Node.Skin = bSkinned ? 0 : -1;
		Scene.Meshes.push_back(MakeQuad(Name, Material, bSkinned));
		Scene.Nodes.push_back(Node);
	};
	const auto AddMaterial = [&] {
		Scene.Materials.emplace_back();
		return static_cast<int32_t>(Scene.Materials.size() - 1);
	};
	if (Content.bObjects) { AddQuad("Plain", 0, false); }
	if (Content.bMasked)
	{
		const int32_t Material = AddMaterial();
		Scene.Materials[Material].AlphaMode = EAlphaMode::Mask;
		AddQuad("Leaves", Material, false);
	}
	if (Content.bGlass)
	{
		const int32_t Material = AddMaterial();
		Scene.Materials[Material].Transmission = 1.0f;
		Scene.Materials[Material].Metallic = 0.0f;
		AddQuad("Pane", Material, false);
	}
	if (Content.bEmissive)
	{
		const int32_t Material = AddMaterial();
		Scene.Materials[Material].Emissive = glm::vec3(100);
		AddQuad("Panel", Material, false);
	}
	if (Content.bTexture)
	{
		FHostImage Image;
		Image.Name = "Picture";
		Image.Width = Image.Height = 4;
		Image.bSrgb = true;
		Image.Rgba.resize(64, 128);
		Scene.Images.push_back(std::move(Image));
		Scene.Textures.push_back({.Image = 0});
		Scene.Materials[0].Slots[TEXTURE_BASE_COLOR].Texture = 0;
	}
	if (Content.bSkinned)
	{
		AddQuad("Body", 0, true);
		Scene.Skins.push_back({{static_cast<int32_t>(Scene.Nodes.size())}, {glm::mat4(1.0f)}});
		Scene.Nodes.emplace_back().Name = "Joint";
	}
	if (Content.bLights)
	{
		Scene.Lights.emplace_back();
		Scene.Nodes.emplace_back().Light = 0;
	}
	return Scene;
}

class FRendererTest : public ::testing::Test
{
protected:
	void SetUp() override
	{
		FConsoleVariables::Get().ResetAll();
		Open();
	}
	void TearDown() override
	{
		Close();
		FConsoleVariables::Get().ResetAll();
		FConsoleVariables::Get().BeginFrame();
	}
	static std::string GetShaderFolder() { return LANTERN_SOURCE_DIR "/Shaders"; }
	void Open(const FRTMockDesc& Desc = {}, const std::vector<std::string>& ShaderFolders = {GetShaderFolder()})
	{
		Close();
		ASSERT_TRUE(CreateMockDevice(Desc, Inner.ReleaseAndGetAddress()));
		const auto OnMessage = [](void* User, const char* Text) { static_cast<FRendererTest*>(User)->Messages.emplace_back(Text); };
		ASSERT_TRUE(WrapWithValidation(Inner.Get(), OnMessage, this, Device.ReleaseAndGetAddress()));
		FRendererDesc Renderer;
		Renderer.ShaderFolders = ShaderFolders;
		Renderer.CacheFolder = LANTERN_TEST_CACHE;
		Engine = std::make_unique<FSampleEngine>(*Device, Renderer);
	}
	/// Whatever happened before: no misuse, no leak, nothing that would have hung a GPU.
	void Close()
	{
		if (Inner)
		{
			Mock().ClearCompileFaults(); // the engine waits for compiles that a failed test has left in the driver
		}
		Engine.reset();
		Device.Reset();
		EXPECT_EQ(Messages, std::vector<std::string>());
		Messages.clear();
		if (Inner) { EXPECT_EQ(Mock().GetErrors(), std::vector<std::string>()); }
		Inner.Reset();
	}
	FRTMock& Mock() { return GetMock(Inner.Get()); }

	FRTStatus Load(const FContent& Content)
	{
		if (FRTStatus Status = Engine->Load(MakeDescription(Content)); !Status) { return Status; }
		ApplySky(Content);
		return FRTStatus::Success();
	}
	void ApplySky(const FContent& Content)
	{
		FSunLight Sun;
		Sun.Irradiance = Content.bSun ? 3.0f : 0.0f;
		Sun.AngularDiameter = 0.01f;
		Engine->GetScene().SetSun(Sun);
		Engine->GetScene().GetScene().SetSky(glm::vec3(Content.bSky ? 1.0f : 0.0f));
	}
	FRTStatus RenderFrame(double Time = 0.0, glm::dvec3 Camera = {0, 0, 5})
	{
		FFrameCapture Capture;
		Capture.bDisplay = Capture.bLighting = true;
		Capture.Signals.Add(ESignal::SunShadow);
		Captured = {};
		return Engine->RenderFrame(LookAt(Camera, {0, 0, 0}, 1.0f, 40, 24), Time, Capture, &Captured);
	}
	/// A frame that must succeed; calls are those of this frame.
	void Render(double Time = 0.0, glm::dvec3 Camera = {0, 0, 5})
	{
		Mock().ClearCalls();
		const FRTStatus Status = RenderFrame(Time, Camera);
		ASSERT_TRUE(Status) << Status.Message;
		EXPECT_EQ(Captured.Display.Width, 40u);
		EXPECT_EQ(Captured.Lighting.Height, 24u);
	}
	void LoadAndRender(const FContent& Content)
	{
		Mock().ClearCalls();
		const FRTStatus Status = Load(Content);
		ASSERT_TRUE(Status) << Status.Message;
		LoadCalls = Mock().GetCalls();
		Render();
	}
	/// In order of execution, readbacks left out.
	std::vector<std::string> GetPasses()
	{
		std::vector<std::string> Names;
		for (const FRTMockCall& Call : Mock().FindCalls(ERTMockCall::BeginMarker))
		{
			if (Call.Name != "Readback") { Names.push_back(Call.Name); }
		}
		return Names;
	}
	/// Those that are left when what follows a noisy signal is left out: its filter, and the surfaces that it follows.
	std::vector<std::string> GetPassesWithoutFilters()
	{
		std::vector<std::string> Names = GetPasses();
		std::erase_if(Names, [](const std::string& Name) {
			return Name == "Surface" || Name == "CameraMotion" || Name.find("Temporal") != std::string::npos ||
			       Name.find("Filter") != std::string::npos;
		});
		return Names;
	}
	bool HasPass(const std::string& Name)
	{
		const std::vector<std::string> Names = GetPasses();
		return std::find(Names.begin(), Names.end(), Name) != Names.end();
	}
	static void Set(const char* Name, const char* Value)
	{
		EXPECT_FALSE(FConsoleVariables::Get().Set(Name, Value, ERTSetBy::Console, "test"));
	}
	const FRTPSO* GetRTPSO() { return Engine->GetRenderer().GetRayPipeline(); }
	/// What a ray of RayType runs at instance and section 0.
	FRTMockRecord Resolve(uint32_t InstanceIndex, uint32_t RayType)
	{
		const auto Instances = Mock().GetSceneInstances(Unwrap(Engine->GetScene().GetScene().GetStructure()));
		EXPECT_LT(InstanceIndex, Instances.size());
		if (InstanceIndex >= Instances.size()) { return {}; }
		IRTShaderTable* const Table = Unwrap(Engine->GetRenderer().GetShaderTable().GetTable());
		return Mock().ResolveHit(Table, Instances[InstanceIndex].Instance, 0, RayType, GetRTPSO()->GetRayTypeCount());
	}

	TRTRef<IRTDevice> Inner, Device;
	std::unique_ptr<FSampleEngine> Engine;
	std::vector<std::string> Messages; ///< of the validation wrapper
	std::vector<FRTMockCall> LoadCalls;
	FCapturedFrame Captured;
};

} // namespace Lantern
