// The world of a play, its choices, and what must hold after each call.
#include "ModulePlay.h"

#include <algorithm>
#include <limits>

#include "LanternRHIValidation/ValidationDevice.h"

namespace Lantern
{

namespace
{

/// Of the frames' textures; those of another size are wrong.
constexpr uint32_t FrameSize = 32;
constexpr ERTFormat TextureFormats[] = {
    ERTFormat::D32_FLOAT, ERTFormat::RGBA16_SNORM, ERTFormat::RGBA32_FLOAT, ERTFormat::RGBA8_SRGB, ERTFormat::RGBA8_UNORM};

std::string Describe(const char* What, const FRTStatus& Status)
{
	return std::string(What) + ": " + std::to_string(static_cast<int>(Status.Code)) + " " + Status.Message;
}

} // namespace

FModulePlay::FModulePlay(IRTModule& InModule) : Module(InModule)
{
	FRTMockDesc Desc;
	Desc.DeviceMemoryBytes = 1ull << 30;
	(void)CreateMockDevice(Desc, Inner.ReleaseAndGetAddress());
	const auto OnMessage = [](void* User, const char* Text) { *static_cast<std::string*>(User) += Text; };
	(void)WrapWithValidation(Inner.Get(), OnMessage, &Messages, Device.ReleaseAndGetAddress());
	(void)Device->CreateSampler({}, Sampler.ReleaseAndGetAddress());
	const auto Import = [&](ERTFormat Format, uint32_t Size, ERTTextureUsage Usage) {
		FRTTextureDesc Texture;
		Texture.Width = Texture.Height = Size;
		Texture.Format = Format;
		Texture.Usage = Usage;
		Textures.emplace_back();
		(void)Device->ImportTexture(Texture, ++LastNative, Textures.back().ReleaseAndGetAddress());
	};
	for (const ERTFormat Format : TextureFormats) { Import(Format, FrameSize, ERTTextureUsage::Sampled); }
	Import(ERTFormat::D32_FLOAT, FrameSize / 2, ERTTextureUsage::Sampled);
	Import(ERTFormat::RGBA16_SNORM, FrameSize, ERTTextureUsage::RenderTarget);
	FRTTextureDesc Cube{8, 8, 1, 6, ERTFormat::RGBA16_FLOAT, ERTTextureUsage::Sampled, "Sky"};
	Cube.bCube = true;
	(void)Device->ImportTexture(Cube, ++LastNative, Sky.ReleaseAndGetAddress());
	constexpr ERTBufferUsage Usage = ERTBufferUsage::GeometryInput | ERTBufferUsage::Storage;
	const FRTBufferDesc Descs[] = {{4096, Usage, ERTMemory::Device, "Vertices"},
	    {4096, ERTBufferUsage::CopyDest, ERTMemory::Device, "Other"}, {16, Usage, ERTMemory::Device, "Small"}};
	for (int I = 0; I < 3; ++I)
	{
		FRTNativeBuffer Native;
		Native.Handle = ++LastNative;
		(void)Device->ImportBuffer(Descs[I], Native, Buffers[I].ReleaseAndGetAddress());
	}
	for (TRTRef<IRTModuleRenderer>& Renderer : Renderers)
	{
		(void)Module.CreateRenderer(Device.Get(), {}, Renderer.ReleaseAndGetAddress());
	}
	MakeWorld();
}

FModulePlay::~FModulePlay() { (void)Finish(); }

void FModulePlay::MakeWorld()
{
	const auto PlayGood = [&](const char* Name) {
		const auto Rows = GetModuleCalls();
		for (size_t Row = 0; Row < Rows.size(); ++Row)
		{
			if (std::string_view(Rows[Row].Name) == Name) { Messages += PlayRow(Row); }
		}
	};
	// Twice, so that each renderer has handles whose slots the other uses, too. What is foreign stays alive there.
	for (int Side = 0; Side < 2; ++Side)
	{
		for (const char* Name :
		    {"AddMaterial", "AddMaterial", "AddMesh", "AddMesh", "AddDeformableMesh", "AddObject", "AddObject", "AddObject", "RemoveObject",
		        "AddMesh", "RemoveMesh", "AddDeformableMesh", "AddMesh", "AddMaterial", "RemoveMaterial", "AddMaterial", "AddLight",
		        "AddLight", "RemoveLight", "AddLight", "AddStreamedMesh", "AddMesh", "AddLandscape", "AddLandscape"})
		{
			PlayGood(Name);
		}
		const auto Turn = [](auto& Of) { Of = {Of.Foreign, {}, Of.Live}; };
		if (Side == 0)
		{
			Turn(Materials), Turn(Meshes), Turn(Deformables), Turn(Objects), Turn(Lights), Turn(Landscapes);
			std::swap(Renderers[0], Renderers[1]);
		}
	}
}

uint8_t FModulePlay::Choose()
{
	++ChoiceCount;
	if (Data.empty()) { return 0; }
	const uint8_t Byte = Data.front();
	Data = Data.subspan(1);
	return Byte;
}

float FModulePlay::Float(const char* Name, float Good)
{
	constexpr float Infinity = std::numeric_limits<float>::infinity();
	constexpr float Bad[] = {std::numeric_limits<float>::quiet_NaN(), Infinity, -Infinity};
	constexpr float Odd[] = {-1.0f, 0.0f, 1e30f, 1e-30f};
	const uint8_t Byte = Choose() % 8;
	if (Byte == 0) { return Good; }
	if (Byte > 3) { return Odd[Byte - 4]; }
	Wrong.emplace_back(Name);
	return Bad[Byte - 1];
}

const float* FModulePlay::Floats(const char* Name, std::span<const float> Good, bool bMayBeNull)
{
	const uint8_t Byte = Choose();
	if (Byte == 1) { return bMayBeNull ? nullptr : Refuse<float>(Name); }
	std::vector<float>& Array = Arrays.emplace_back(Good.begin(), Good.end());
	if (Byte % 8 == 2)
	{
		Array[Byte / 8 % Array.size()] = std::numeric_limits<float>::quiet_NaN();
		Wrong.emplace_back(Name);
	}
	return Array.data();
}

uint32_t FModulePlay::Count(const char* Name, uint32_t Good)
{
	const uint8_t Byte = Choose() % 4;
	if (Byte != 1 && Byte != 2) { return Good; }
	Wrong.emplace_back(Name);
	return Byte == 1 ? 0 : ~0u;
}

uint32_t FModulePlay::Index(const char* Name, uint32_t Good)
{
	if (Choose() % 4 != 1) { return Good; }
	Wrong.emplace_back(Name);
	return ~0u;
}

uint32_t FModulePlay::Number(const char* Name, uint32_t Good, uint32_t Bad)
{
	if (Choose() % 4 != 1) { return Good; }
	Wrong.emplace_back(Name);
	return Bad;
}

const TPlayHandles<ERTMeshHandle>& FModulePlay::AnyMeshes(uint32_t& OutSections)
{
	const uint8_t Byte = Choose() % 4;
	OutSections = Byte == 2 ? 1 : 2;
	return Byte == 1 ? Deformables : Byte == 2 ? Landscapes : Meshes;
}

IRTBuffer* FModulePlay::Buffer(const char* Name, bool bMayBeNull)
{
	const uint8_t Byte = Choose() % 4;
	if (Byte == 1) { return bMayBeNull ? nullptr : Refuse<IRTBuffer>(Name); }
	if (Byte != 0) { Wrong.emplace_back(Name); }
	return Buffers[Byte == 0 ? 0 : Byte - 1].Get();
}

IRTTexture* FModulePlay::SampledTexture(const char* Name)
{
	const uint8_t Byte = Choose() % 4;
	if (Byte == 1) { Wrong.emplace_back(Name); }
	return Byte == 1 ? Textures.back().Get() : Byte == 2 ? nullptr : Textures.front().Get();
}

IRTTexture* FModulePlay::Texture(const char* Name, ERTFormat Good, bool bMayBeNull, std::initializer_list<ERTFormat> Others)
{
	const uint8_t Byte = Choose();
	if (Byte == 1) { return bMayBeNull ? nullptr : Refuse<IRTTexture>(Name); }
	IRTTexture* Fit = nullptr;
	for (const TRTRef<IRTTexture>& Texture : Textures) { Fit = Fit == nullptr && Texture->GetDesc().Format == Good ? Texture.Get() : Fit; }
	if (Byte == 0) { return Fit; }
	IRTTexture* const Other = Textures[Byte % Textures.size()].Get();
	const bool bAsGood = std::find(Others.begin(), Others.end(), Other->GetDesc().Format) != Others.end();
	if (Other != Fit && !bAsGood) { Wrong.emplace_back(Name); }
	return Other;
}

IRTCommandList* FModulePlay::MakeList()
{
	(void)Device->ImportCommandList(++LastNative, List.ReleaseAndGetAddress());
	return List.Get();
}

std::string FModulePlay::CheckStatus(const char* Name) const
{
	if (!Status && Status.Message[0] == 0) { return std::string(Name) + " failed without a word"; }
	if (Wrong.empty()) { return {}; }
	if (Status.Code != ERTResult::InvalidArgument) { return Describe(Name, Status) + ", though it must refuse " + Wrong.front(); }
	// Which of several is named, and whether something else is said first, is the module's choice.
	const bool bNamed = !bSingleDeviation || std::string_view(Status.Message).find(Wrong.front()) != std::string_view::npos;
	return bNamed ? std::string() : std::string(Name) + " does not name " + Wrong.front() + ": " + Status.Message;
}

std::string FModulePlay::PlayRow(size_t Row)
{
	Wrong.clear();
	Arrays.clear();
	ChoiceCount = 0;
	// What is refused makes nothing. Shaders are compiled at any time.
	const auto CountWork = [&] {
		return GetMock().CountCalls(ERTMockCall::CreateGeometry) + GetMock().CountCalls(ERTMockCall::BeginMarker);
	};
	const uint32_t Before = CountWork();
	const FModuleCall& Call = GetModuleCalls()[Row];
	Status = Call.Call(*this);
	if (Status.Code == ERTResult::InvalidArgument && CountWork() != Before)
	{
		return std::string(Call.Name) + " refused, and did something";
	}
	return CheckStatus(Call.Name);
}

std::string FModulePlay::Play(std::span<const uint8_t> Bytes)
{
	Data = Bytes;
	std::string Problem;
	while (Problem.empty() && !Data.empty())
	{
		const size_t Row = Choose() % GetModuleCalls().size();
		Problem = PlayRow(Row);
	}
	Data = {};
	return Problem.empty() ? RenderGoodFrame() : Problem;
}

std::string FModulePlay::PlayDeviation(size_t Row, size_t Choice, uint8_t Deviation)
{
	Data = {};
	if (const int Before = GetModuleCalls()[Row].Before; Before >= 0) { (void)PlayRow(static_cast<size_t>(Before)); }
	std::vector<uint8_t> Bytes(Choice + 1, 0);
	Bytes[Choice] = Deviation;
	Data = Bytes;
	bSingleDeviation = true;
	std::string Problem = PlayRow(Row);
	bSingleDeviation = false;
	Data = {};
	return Problem;
}

std::string FModulePlay::RenderGoodFrame()
{
	(void)GetRenderer().EndFrame(nullptr);
	std::string Problem;
	for (const char* Name : {"AddMaterial", "AddMesh", "AddObject", "SetSun", "RenderFrame", "EndFrame"})
	{
		for (size_t Row = 0; Problem.empty() && Row < GetModuleCalls().size(); ++Row)
		{
			if (std::string_view(GetModuleCalls()[Row].Name) != Name) { continue; }
			Problem = PlayRow(Row);
			if (Problem.empty() && !Status) { Problem = Describe("a good call afterwards", Status) + " by " + Name; }
		}
	}
	return Problem;
}

std::string FModulePlay::Finish()
{
	for (TRTRef<IRTModuleRenderer>& Renderer : Renderers) { Renderer.Reset(); }
	List.Reset();
	Sampler.Reset();
	Textures.clear();
	Sky.Reset();
	for (TRTRef<IRTBuffer>& Each : Buffers) { Each.Reset(); }
	Device.Reset();
	std::string Problem = Messages;
	if (Inner)
	{
		for (const std::string& Error : GetMock().GetErrors()) { Problem += Error; }
	}
	Inner.Reset();
	return Problem;
}

} // namespace Lantern
