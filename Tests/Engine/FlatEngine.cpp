// FFlatEngineTest: constant G-buffer, frames and readback.
#include "FlatEngine.h"

#include <algorithm>
#include <cmath>
#include <cstring>

#include <glm/gtc/packing.hpp>

#include "LanternRHIVulkan/VulkanDevice.h"
#include "LanternScene/Memory/Upload.h"

namespace Lantern
{

double FSignalPicture::GetLargestDifference(const FSignalPicture& Other) const
{
	double Largest = 0.0;
	for (const auto& [Signal, Values] : Signals)
	{
		const std::vector<float>& Theirs = Other.Signals.at(Signal);
		for (size_t I = 0; I < Values.size(); ++I) { Largest = std::max(Largest, std::abs(double(Values[I]) - double(Theirs[I]))); }
	}
	return Largest;
}

double FSignalPicture::GetMeanDifference(const FSignalPicture& Other) const
{
	double Sum = 0.0, Mean = 0.0;
	for (const auto& [Signal, Values] : Signals)
	{
		const std::vector<float>& Theirs = Other.Signals.at(Signal);
		for (size_t I = 0; I < Values.size(); ++I)
		{
			Sum += std::abs(double(Values[I]) - double(Theirs[I]));
			Mean += std::abs(double(Values[I]));
		}
	}
	return Mean > 0.0 ? Sum / Mean : Sum;
}

double FSignalPicture::GetMean(ESignal Signal) const
{
	double Sum = 0.0;
	for (const float Value : Signals.at(Signal)) { Sum += double(Value); }
	return Sum / double(Signals.at(Signal).size());
}

void FFlatEngineTest::SetUp()
{
	ASSERT_EQ(LanternCreateModule(ModuleVersion, Module.ReleaseAndGetAddress()), 0);
	FRTModuleDesc Desc;
	Desc.ShaderFolder = LANTERN_SOURCE_DIR "/Shaders";
	Desc.CacheFolder = LANTERN_TEST_CACHE;
	ASSERT_OK(Module->Initialize(Desc));
	for (const char* const Name : {"r.RT.GI", "r.RT.Reflections"}) { SetVariable(Name, "1"); }
	// Pixels are compared with the truth, frame by frame.
	for (const char* const Name : {"r.RT.GI.Denoise", "r.RT.Reflections.Denoise"}) { SetVariable(Name, "0"); }
	SetVariable("r.RT.Pipeline.Fallback", "2");
	SetVariable("r.RT.Build.TrianglesPerFrame", "100000000");
	SetVariable("r.RT.Shadow.Soft", "0");
	SetVariable("r.RT.Culling", "0");
	ASSERT_OK(Module->CreateDevice(true, Device.ReleaseAndGetAddress()));
	const auto Constant = [&](ERTFormat Format, auto Texel, const char* Name) {
		const std::vector<decltype(Texel)> Texels(size_t(Size) * Size, Texel);
		return MakeTexture({Size, Size, 1, 1, Format, ERTTextureUsage::Sampled, Name}, Texels.data());
	};
	// Native: near 1 over the distance; both normals upwards.
	Depth = Constant(ERTFormat::R32_FLOAT, float(1.0 / CameraHeight), "EngineDepth");
	Normals = Constant(ERTFormat::RGBA16_SNORM, glm::packSnorm4x16(glm::vec4(0, 1, 0, 1)), "EngineNormals");
	BaseColor = Constant(ERTFormat::RGBA8_SRGB, glm::packUnorm4x8(glm::vec4(0.8f, 0.8f, 0.8f, 0.0f)), "EngineBaseColor");
	Material = Constant(ERTFormat::RGBA8_UNORM, glm::packUnorm4x8(glm::vec4(0.25f, 1.0f, 0.2f, 1.0f)), "EngineMaterial");
}

void FFlatEngineTest::TearDown()
{
	if (Device)
	{
		EXPECT_TRUE(Device->WaitIdle().IsOk());
		EXPECT_EQ(Device->GetValidationMessageCount(), 0u);
	}
	Readbacks.clear();
	Owned.clear();
	for (TRTRef<IRTTexture>* const Texture : {&Depth, &Normals, &BaseColor, &Material, &Classes}) { Texture->Reset(); }
	Device.Reset();
	Module.Reset();
}

TRTRef<IRTTexture> FFlatEngineTest::MakeTexture(const FRTTextureDesc& Desc, const void* Texels)
{
	FRTTextureDesc Mine = Desc;
	Mine.Usage = Desc.Usage | ERTTextureUsage::CopyDest;
	TRTRef<IRTTexture> Out;
	FRTStatus Status = Device->CreateTexture(Mine, Out.ReleaseAndGetAddress());
	const uint64_t Bytes = uint64_t(Desc.Width) * Desc.Height * BytesPerTexel(Desc.Format);
	TRTRef<IRTBuffer> Staging;
	const FRTBufferDesc StagingDesc{Bytes * Desc.ArraySize, ERTBufferUsage::CopySource, ERTMemory::Upload, "Staging"};
	if (Status) { Status = Device->CreateBuffer(StagingDesc, Staging.ReleaseAndGetAddress()); }
	TRTRef<IRTCommandList> List;
	if (Status) { Status = Device->CreateCommandList("Upload", List.ReleaseAndGetAddress()); }
	if (Status) { Status = List->Begin(); }
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	if (!Status) { return Out; }
	std::memcpy(Staging->GetMapped(), Texels, Bytes * Desc.ArraySize);
	const FRTBarrier Before{nullptr, Out.Get(), ERTAccess::None, ERTAccess::CopyWrite};
	const FRTBarrier After{nullptr, Out.Get(), ERTAccess::CopyWrite, ERTAccess::ShaderRead};
	List->Barriers(&Before, 1);
	for (uint32_t Layer = 0; Layer < Desc.ArraySize; ++Layer)
	{
		List->CopyBufferToTexture(Out.Get(), 0, Layer, Staging.Get(), Bytes * Layer);
	}
	List->Barriers(&After, 1);
	Status = List->End();
	IRTCommandList* const Lists[] = {List.Get()};
	if (Status) { Status = Device->Submit(Lists, 1, nullptr); }
	if (Status) { Status = Device->WaitIdle(); }
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	return Out;
}

TRTRef<IRTBuffer> FFlatEngineTest::ImportBytes(const std::vector<uint8_t>& Bytes, const char* Name)
{
	constexpr ERTBufferUsage Usage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage;
	const FRTBufferDesc Desc{Bytes.size(), Usage, ERTMemory::Upload, Name};
	TRTRef<IRTBuffer> Out;
	FRTStatus Status = Device->CreateBuffer(Desc, Owned.emplace_back().ReleaseAndGetAddress());
	if (Status)
	{
		std::memcpy(Owned.back()->GetMapped(), Bytes.data(), Bytes.size());
		FRTNativeBuffer Native;
		Native.Handle = Owned.back()->GetNative(ERTNative::Buffer);
		Status = Device->ImportBuffer(Desc, Native, Out.ReleaseAndGetAddress());
	}
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	return Out;
}

ERTObjectHandle FFlatEngineTest::Place(
    IRTModuleRenderer& Renderer, ERTMeshHandle Mesh, ERTMaterialHandle Material, glm::dvec3 At, double Scale)
{
	FRTModuleObject Object;
	const ERTMaterialHandle Materials[] = {Material, Material};
	Object.Mesh = Mesh;
	Object.Materials = Materials;
	Object.MaterialCount = 1;
	for (int Axis = 0; Axis < 3; ++Axis)
	{
		Object.Transform[Axis * 4 + Axis] = Scale;
		Object.Transform[Axis * 4 + 3] = At[Axis];
	}
	ERTObjectHandle Out = ERTObjectHandle::None;
	const FRTStatus Status = Renderer.AddObject(Object, &Out);
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	return Out;
}

ERTMeshHandle FFlatEngineTest::AddSquare(IRTModuleRenderer& Renderer, float Half, float Height)
{
	const float Positions[] = {-Half, Height, -Half, Half, Height, -Half, Half, Height, Half, -Half, Height, Half};
	const uint32_t Indices[] = {0, 1, 2, 0, 2, 3};
	FRTModuleMesh Mesh;
	Mesh.Positions = Positions;
	Mesh.VertexCount = 4;
	Mesh.Indices = Indices;
	Mesh.IndexCount = 6;
	ERTMeshHandle Out = ERTMeshHandle::None;
	EXPECT_OK(Renderer.AddMesh(Mesh, &Out));
	return Out;
}

void FFlatEngineTest::AddVerticalLights(IRTModuleRenderer& Renderer, double LampHeight)
{
	FRTModuleSun Sun;
	Sun.Direction[0] = Sun.Direction[2] = 0.0f;
	Sun.Direction[1] = LampHeight > 0.0 ? -1.0f : 1.0f;
	Sun.Irradiance = 4.0f;
	ASSERT_OK(Renderer.SetSun(Sun));
	FRTModuleLight Lamp;
	Lamp.Position[1] = LampHeight;
	for (float& Channel : Lamp.Color) { Channel = float(LampCandela); }
	ERTLightHandle Handle = ERTLightHandle::None;
	ASSERT_OK(Renderer.AddLight(Lamp, &Handle));
}

std::pair<double, double> FFlatEngineTest::GetHalves(const FSignalPicture& Picture, ESignal Signal)
{
	const std::vector<float>& Values = Picture.Signals.at(Signal);
	const size_t Channels = GetSignalInfo(Signal).Channels;
	double Sums[2] = {};
	for (size_t I = 0; I < size_t(Size) * Size; ++I) { Sums[I % Size >= Size / 2] += double(Values[I * Channels]); }
	constexpr double Half = double(Size) * Size / 2.0;
	return {Sums[0] / Half, Sums[1] / Half};
}

FRTModuleFrame FFlatEngineTest::DescribeFrame() const
{
	FRTModuleFrame Frame;
	Frame.View.Position[1] = CameraHeight;
	Frame.View.Forward[1] = -1.0f;
	Frame.View.Forward[2] = 0.0f;
	Frame.View.Up[1] = 0.0f;
	Frame.View.Up[2] = -1.0f;
	Frame.View.Projection = MakeProjection(1.5707963f, 1.0f, 1.0f);
	Frame.Depth = Depth.Get();
	Frame.Normals = Normals.Get();
	Frame.BaseColor = BaseColor.Get();
	Frame.Material = Material.Get();
	Frame.Classes = Classes.Get();
	return Frame;
}

void FFlatEngineTest::Read(IRTCommandList& List, const FRTModuleOutputs& Outputs, const FSignalSet& Wanted)
{
	for (const FSignalInfo& Info : SignalInfos)
	{
		if (!Wanted.Has(Info.Signal)) { continue; }
		IRTTexture* const Texture = Outputs.Get(Info.Signal);
		ASSERT_NE(Texture, nullptr) << Info.Name;
		TRTRef<IRTBuffer>& Buffer = Readbacks[Info.Signal];
		const uint64_t Bytes = uint64_t(Size) * Size * BytesPerTexel(Info.Format);
		ASSERT_OK(Device->CreateBuffer({Bytes, ERTBufferUsage::CopyDest, ERTMemory::Readback, "Readback"}, Buffer.ReleaseAndGetAddress()));
		const FRTBarrier Before{nullptr, Texture, ERTAccess::ShaderRead, ERTAccess::CopyRead};
		const FRTBarrier After[] = {{nullptr, Texture, ERTAccess::CopyRead, ERTAccess::ShaderRead},
		    {Buffer.Get(), nullptr, ERTAccess::CopyWrite, ERTAccess::HostRead}};
		List.Barriers(&Before, 1);
		List.CopyTextureToBuffer(Buffer.Get(), 0, Texture, 0, 0);
		List.Barriers(After, 2);
	}
}

void FFlatEngineTest::RenderFrame(IRTModuleRenderer& Renderer, FRTModuleFrame Frame, FSignalPicture* Out)
{
	TRTRef<IRTCommandList> List, Imported;
	ASSERT_OK(Device->CreateCommandList("Engine", List.ReleaseAndGetAddress()));
	ASSERT_OK(List->Begin());
	ASSERT_OK(Device->ImportCommandList(List->GetNative(ERTNative::CommandBuffer), Imported.ReleaseAndGetAddress()));
	Frame.Commands = Imported.Get();
	FRTModuleOutputs Outputs;
	ASSERT_OK(Renderer.RenderFrame(Frame, &Outputs));
	if (Out != nullptr)
	{
		EXPECT_TRUE(Outputs.bComplete);
		Read(*List, Outputs, Frame.Wanted);
	}
	ASSERT_OK(List->End());
	IRTCommandList* const Lists[] = {List.Get()};
	ASSERT_OK(Device->Submit(Lists, 1, nullptr));
	ASSERT_OK(Renderer.EndFrame(nullptr));
	ASSERT_OK(Device->WaitIdle());
	if (Out == nullptr) { return; }
	for (const auto& [Signal, Buffer] : Readbacks)
	{
		const auto* const Halves = static_cast<const uint16_t*>(Buffer->GetMapped());
		const size_t PerTexel = BytesPerTexel(GetSignalInfo(Signal).Format) / 2;
		std::vector<float>& Values = Out->Signals[Signal];
		for (size_t Pixel = 0; Pixel < size_t(Size) * Size; ++Pixel)
		{
			for (size_t Channel = 0; Channel < GetSignalInfo(Signal).Channels; ++Channel)
			{
				Values.push_back(glm::unpackHalf1x16(Halves[Pixel * PerTexel + Channel]));
			}
		}
	}
}

FSignalPicture FFlatEngineTest::Render(const std::function<void(IRTModuleRenderer&)>& Fill, const FSignalSet& Wanted)
{
	constexpr int Frames = 6;
	FSignalPicture Out;
	TRTRef<IRTModuleRenderer> Renderer;
	const FRTStatus Status = Module->CreateRenderer(Device.Get(), RendererDesc, Renderer.ReleaseAndGetAddress());
	EXPECT_TRUE(Status.IsOk()) << Status.Message;
	if (!Status) { return Out; }
	Fill(*Renderer);
	FRTModuleFrame Frame = DescribeFrame();
	Frame.Wanted = Wanted;
	if (ChangeFrame) { ChangeFrame(Frame); }
	Readbacks.clear();
	for (int Index = 0; Index < Frames && !HasFatalFailure(); ++Index)
	{
		if (BeforeFrame) { BeforeFrame(*Renderer, Index); }
		RenderFrame(*Renderer, Frame, Index + 1 == Frames ? &Out : nullptr);
	}
	return Out;
}

} // namespace Lantern
