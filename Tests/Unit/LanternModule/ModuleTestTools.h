// For the tests of the module: its library on a mock device behind the validation wrapper, with a triangle to add.
#pragma once

#include <cstring>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "LanternModule/Module.h"
#include "LanternRHIMock/MockDevice.h"
#include "LanternRHIValidation/ValidationDevice.h"
#include "SceneTypes.h"
#include "Support/MockReads.h"
#include "Support/StatusChecks.h"
#include "Support/WaitTools.h"

namespace Lantern
{

#define EXPECT_REFUSED(Expression, Part)                                                                                                   \
	do {                                                                                                                                   \
		const FRTStatus Refused = (Expression);                                                                                            \
		EXPECT_EQ(Refused.Code, ERTResult::InvalidArgument);                                                                               \
		EXPECT_THAT(Refused.Message, ::testing::HasSubstr(Part));                                                                          \
	}                                                                                                                                      \
	while (false)
inline constexpr float TrianglePositions[] = {0, 0, 0, 1, 0, 0, 0, 1, 0};
inline constexpr uint32_t TriangleIndices[] = {0, 1, 2};

class FModuleTest : public ::testing::Test
{
protected:
	void SetUp() override { Open(DescribeMock()); }
	void Open(const FRTMockDesc& Mock)
	{
		ASSERT_OK(CreateMockDevice(Mock, Inner.ReleaseAndGetAddress()));
		const auto OnMessage = [](void* User, const char* Text) { static_cast<FModuleTest*>(User)->Messages.emplace_back(Text); };
		ASSERT_OK(WrapWithValidation(Inner.Get(), OnMessage, this, Device.ReleaseAndGetAddress()));
		ASSERT_EQ(LanternCreateModule(ModuleVersion, Module.ReleaseAndGetAddress()), 0);
		FRTModuleDesc Desc;
		Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
		Desc.CacheFolder = LANTERN_TEST_CACHE;
		ASSERT_OK(Module->Initialize(Desc));
		ASSERT_OK(Module->CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress()));
		ASSERT_OK(Renderer->AddMaterial({}, &Solid));
		FRTModuleMaterial Material;
		Material.bMasked = true;
		ASSERT_OK(Renderer->AddMaterial(Material, &Masked));
		Depth = MakeTexture(ERTFormat::D32_FLOAT, 64);
		Normals = MakeTexture(ERTFormat::RGBA16_SNORM, 64);
	}
	void TearDown() override
	{
		for (const auto& [Name, Value] : ChangedVariables) { ASSERT_OK(Module->SetConsoleVariable(Name.c_str(), Value.c_str())); }
		Mock().ClearCompileFaults(); // the renderer waits for compiles that a failed test has left in the driver
		Renderer.Reset();
		Module.Reset();
		List.Reset();
		Depth.Reset();
		Normals.Reset();
		Device.Reset();
		EXPECT_EQ(Messages, std::vector<std::string>());
		EXPECT_EQ(GetMock(Inner.Get()).GetErrors(), std::vector<std::string>());
	}
	/// Sets a console variable until the end of the test.
	void SetVariable(const char* Name, const char* Value)
	{
		char Before[64];
		ASSERT_OK(Module->GetConsoleVariable(Name, Before, sizeof(Before)));
		ChangedVariables.insert(ChangedVariables.begin(), {Name, Before});
		ASSERT_OK(Module->SetConsoleVariable(Name, Value));
	}
	virtual FRTMockDesc DescribeMock() const { return {}; }
	FRTMock& Mock() { return GetMock(Inner.Get()); }
	TRTRef<IRTTexture> MakeTexture(
	    ERTFormat Format, uint32_t Size, ERTTextureUsage Usage = ERTTextureUsage::Sampled, const char* Name = "Test")
	{
		FRTTextureDesc Desc;
		Desc.Width = Desc.Height = Size;
		Desc.Format = Format;
		Desc.Usage = Usage;
		Desc.Name = Name;
		TRTRef<IRTTexture> Out;
		const FRTStatus Status = Device->ImportTexture(Desc, ++LastNative, Out.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Out;
	}
	static FRTModuleMesh DescribeTriangle()
	{
		FRTModuleMesh Mesh;
		Mesh.Name = "Triangle";
		Mesh.Positions = TrianglePositions;
		Mesh.VertexCount = 3;
		Mesh.Indices = TriangleIndices;
		Mesh.IndexCount = 3;
		return Mesh;
	}
	ERTMeshHandle AddMesh(const FRTModuleMesh& Mesh)
	{
		ERTMeshHandle Handle = ERTMeshHandle::None;
		const FRTStatus Status = Renderer->AddMesh(Mesh, &Handle);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		return Handle;
	}
	/// One section that cannot be alpha-tested.
	ERTMeshHandle AddOpaqueMesh()
	{
		const FRTModuleSection Section{0, 3, false};
		FRTModuleMesh Mesh = DescribeTriangle();
		Mesh.Name = "Wall";
		Mesh.Sections = &Section;
		Mesh.SectionCount = 1;
		return AddMesh(Mesh);
	}
	/// A triangle named "Cloth" whose vertices may be updated.
	ERTMeshHandle AddDeformableMesh()
	{
		FRTModuleMesh Mesh = DescribeTriangle();
		Mesh.Name = "Cloth";
		Mesh.bDeformable = true;
		return AddMesh(Mesh);
	}
	/// A material with a base colour texture. The plugin holds the texture once the material is added and Texture is reset.
	struct FTexturedMaterial
	{
		TRTRef<IRTSampler> Sampler;
		TRTRef<IRTTexture> Texture;
		FRTModuleMaterial Material;
	};
	FTexturedMaterial MakeTexturedMaterial(const char* TextureName)
	{
		FTexturedMaterial Out;
		const FRTStatus Status = Device->CreateSampler({}, Out.Sampler.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		Out.Texture = MakeTexture(ERTFormat::RGBA8_SRGB, 4, ERTTextureUsage::Sampled, TextureName);
		Out.Material.BaseColorMap.Texture = Out.Texture.Get();
		Out.Material.BaseColorMap.Sampler = Out.Sampler.Get();
		return Out;
	}
	/// Objects of the name that were destroyed so far, after collecting garbage.
	uint32_t CountDestroyed(const char* Name)
	{
		Device->CollectGarbage();
		return Mock().CountCalls(ERTMockCall::Destroy, Name);
	}
	FRTStatus AddObject(ERTMeshHandle Mesh, ERTMaterialHandle Material)
	{
		FRTModuleObject Desc;
		Desc.Mesh = Mesh;
		Desc.Materials = &Material;
		Desc.MaterialCount = 1;
		return Renderer->AddObject(Desc, &Object);
	}
	FRTStatus SetSun(double Y, float Irradiance = 1.0f)
	{
		FRTModuleSun Sun;
		Sun.Direction[1] = Y;
		Sun.Irradiance = Irradiance;
		return Renderer->SetSun(Sun);
	}
	static FRTModuleView MakeView()
	{
		FRTModuleView View;
		View.Projection = MakeProjection(1.0f, 1.0f, 0.1f);
		return View;
	}
	FRTModuleFrame DescribeFrame()
	{
		const FRTStatus Status = Device->ImportCommandList(++LastNative, List.ReleaseAndGetAddress());
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
		FRTModuleFrame Frame;
		Frame.Commands = List.Get();
		Frame.Depth = Depth.Get();
		Frame.Normals = Normals.Get();
		Frame.View = MakeView();
		return Frame;
	}
	/// A frame whose shaders are there, unless bPrecache is off.
	FRTStatus Render()
	{
		const FRTModuleFrame Frame = DescribeFrame();
		Precache(Frame);
		return Renderer->RenderFrame(Frame, &Outputs);
	}
	void Precache(const FRTModuleFrame& Frame)
	{
		if (!bPrecache) { return; }
		const FRTStatus Status = Renderer->Precache(Frame, nullptr, nullptr);
		EXPECT_TRUE(Status.IsOk()) << Status.Message;
	}
	FRTStatus RenderWholeFrame()
	{
		const FRTStatus Status = Render();
		return Status ? Renderer->EndFrame(nullptr) : Status;
	}
	/// Renders until some pass traces and no shader is missing, and returns the scene as its shaders see it.
	FSceneConstants ReadConstants(const FRTModuleFrame& From)
	{
		FSceneConstants Out{};
		const auto Find = [&] {
			if (!Outputs.bShadersReady) { return false; } // emissive triangles, for one, come with a shader of their own
			for (const ERTMockCall Kind : {ERTMockCall::TraceRays, ERTMockCall::Dispatch})
			{
				for (const FRTMockCall& Call : Mock().FindCalls(Kind))
				{
					FPassConstants Pushed{};
					if (Call.Bytes.size() < sizeof(Pushed)) { continue; }
					std::memcpy(&Pushed, Call.Bytes.data(), sizeof(Pushed));
					uint64_t Offset = 0;
					IRTBuffer* const Buffer = Mock().FindBuffer(Pushed.Scene, &Offset);
					if (Buffer == nullptr) { continue; }
					std::memcpy(&Out, Mock().GetBytes(Buffer) + Offset, sizeof(Out));
					return true;
				}
			}
			return false;
		};
		FRTModuleFrame Frame = From;
		const auto Step = [&] {
			Frame.Commands = DescribeFrame().Commands;
			Mock().ClearCalls();
			ASSERT_OK(Renderer->RenderFrame(Frame, &Outputs));
			ASSERT_OK(Renderer->EndFrame(nullptr));
			GiveWay();
		};
		Mock().ClearCalls();
		EXPECT_TRUE(WaitUntil("a pass that traces", Find, Step));
		return Out;
	}
	/// Reads entry Index of an array of the scene.
	template <class T>
	T ReadEntry(uint64_t Address, uint32_t Index)
	{
		return ReadMockEntry<T>(Mock(), Address, Index);
	}
	/// A sun overhead, whose soft shadows are filtered.
	void SetSoftSun()
	{
		FRTModuleSun Sun;
		Sun.Direction[1] = -1.0;
		Sun.Irradiance = 1.0f;
		Sun.AngularDiameter = 0.01f;
		ASSERT_OK(Renderer->SetSun(Sun));
	}
	/// Buffers of the name that were copied to in the calls so far.
	uint32_t CountCopies(const char* Name) { return Mock().CountCalls(ERTMockCall::CopyBuffer, Name); }

	TRTRef<IRTDevice> Inner, Device;
	TRTRef<IRTModule> Module;
	TRTRef<IRTModuleRenderer> Renderer;
	TRTRef<IRTTexture> Depth, Normals;
	TRTRef<IRTCommandList> List;
	ERTMaterialHandle Solid = ERTMaterialHandle::None, Masked = ERTMaterialHandle::None;
	ERTObjectHandle Object = ERTObjectHandle::None;
	FRTModuleOutputs Outputs;
	std::vector<std::string> Messages;
	std::vector<std::pair<std::string, std::string>> ChangedVariables;
	uint64_t LastNative = 0;
	bool bPrecache = true; ///< off: shaders compile beside the frames
};

} // namespace Lantern
