// Plays sequences of module calls that bytes choose, on a mock: for the fuzzer, for what it found, and for a sweep over all wrong
// arguments. A new call is a row of ModuleCalls.cpp.
#pragma once

#include <cstdint>
#include <deque>
#include <initializer_list>
#include <map>
#include <span>
#include <string>
#include <vector>

#include "LanternModule/Module.h"
#include "LanternRHIMock/MockDevice.h"

namespace Lantern
{

/// What an engine has of one kind: handles that live, that were removed, and that another renderer gave.
template <class THandle>
struct TPlayHandles
{
	std::vector<THandle> Live, Stale, Foreign;
};

/// Two renderers on one mock device behind the validation wrapper, and the source of all choices.
/// Each choice takes one byte. 0, and the end of the data, is what a careful engine would pass.
class FModulePlay
{
public:
	/// Module is initialised. The first renderer is the one that the calls go to.
	explicit FModulePlay(IRTModule& InModule);
	FModulePlay(const FModulePlay&) = delete;
	~FModulePlay();

	/// Plays calls: a byte chooses the row, further ones its arguments. Returns what went wrong, or nothing.
	std::string Play(std::span<const uint8_t> Bytes);
	/// Plays one call with one argument that is not a careful engine's.
	std::string PlayDeviation(size_t Row, size_t Choice, uint8_t Deviation);
	/// Has the number of choices of the last call.
	size_t GetChoiceCount() const { return ChoiceCount; }
	const FRTStatus& GetStatus() const { return Status; }
	/// A frame that a careful engine draws now. Returns what went wrong, or nothing.
	std::string RenderGoodFrame();
	/// Ends the play: no renderer is left. Returns what mock and validation have to say.
	std::string Finish();

	// ---------------------------------------------------------------------------------------------- choices
	// Name: what the error must say if the choice is one that every renderer refuses.
	uint8_t Choose();
	float Float(const char* Name, float Good);
	double Double(const char* Name, double Good) { return Float(Name, static_cast<float>(Good)); }
	bool Bool(bool bGood) { return Choose() % 2 == 0 ? bGood : !bGood; }
	/// One of the arrays' elements may become wrong. Returns Good's elements or null.
	const float* Floats(const char* Name, std::span<const float> Good, bool bMayBeNull);
	uint32_t Count(const char* Name, uint32_t Good);
	template <class T>
	T* Pointer(const char* Name, T* Good)
	{
		return Choose() % 4 == 1 ? Refuse<T>(Name) : Good;
	}
	template <class THandle>
	THandle Handle(const char* Name, const TPlayHandles<THandle>& Of);
	/// What was chosen so far is not looked at.
	void ExpectNothing() { Wrong.clear(); }
	/// Takes up a handle that a call gave.
	template <class THandle>
	void Keep(TPlayHandles<THandle>& Of, THandle Handle);
	template <class THandle>
	void Forget(TPlayHandles<THandle>& Of, THandle Handle);
	uint32_t Index(const char* Name, uint32_t Good);
	/// Bad: what the call must refuse, where ~0 would be fine or could not be seen.
	uint32_t Number(const char* Name, uint32_t Good, uint32_t Bad);
	/// Meshes of any kind for an object. OutSections: how many materials they need.
	const TPlayHandles<ERTMeshHandle>& AnyMeshes(uint32_t& OutSections);
	/// Others: formats that do as well.
	IRTTexture* Texture(const char* Name, ERTFormat Good, bool bMayBeNull, std::initializer_list<ERTFormat> Others = {});
	/// Of any format, as materials take them.
	IRTTexture* SampledTexture(const char* Name);
	/// A buffer of the engine's, large enough for anything.
	IRTBuffer* Buffer(const char* Name, bool bMayBeNull);
	IRTTexture* GetSky() const { return Sky.Get(); }
	IRTSampler* GetSampler() const { return Sampler.Get(); }
	IRTCommandList* MakeList();

	IRTModuleRenderer& GetRenderer() const { return *Renderers[0]; }
	IRTModule& GetModule() const { return Module; }
	IRTDevice* GetDevice() const { return Device.Get(); }
	FRTMock& GetMock() const { return Lantern::GetMock(Inner.Get()); }

	TPlayHandles<ERTMaterialHandle> Materials;
	TPlayHandles<ERTMeshHandle> Meshes, Deformables, Landscapes;
	TPlayHandles<ERTObjectHandle> Objects;
	TPlayHandles<ERTLightHandle> Lights;
	/// What meshes were given that another device must be given again.
	struct FAsset
	{
		bool bSections = false, bMayBeMasked = false, bDeformable = false;
	};
	std::map<ERTMeshHandle, FAsset> Assets;

private:
	template <class T>
	T* Refuse(const char* Name)
	{
		Wrong.emplace_back(Name);
		return nullptr;
	}
	void MakeWorld();
	std::string PlayRow(size_t Row);
	std::string CheckStatus(const char* Name) const;

	IRTModule& Module;
	TRTRef<IRTDevice> Inner, Device;
	TRTRef<IRTModuleRenderer> Renderers[2];
	TRTRef<IRTSampler> Sampler;
	std::vector<TRTRef<IRTTexture>> Textures;
	TRTRef<IRTTexture> Sky;
	TRTRef<IRTBuffer> Buffers[3]; ///< good, without the usages, too small
	TRTRef<IRTCommandList> List;
	uint64_t LastNative = 0;
	std::span<const uint8_t> Data;
	size_t ChoiceCount = 0;
	bool bSingleDeviation = false;
	std::vector<std::string> Wrong;        ///< names of this call's arguments that must be refused
	std::deque<std::vector<float>> Arrays; ///< of this call
	FRTStatus Status;
	std::string Messages; ///< of validation
};

/// A call of the module with arguments that Play chooses.
struct FModuleCall
{
	const char* Name;
	FRTStatus (*Call)(FModulePlay& Play);
	/// Row to be played before in a sweep; −1: none.
	int Before = -1;
};

std::span<const FModuleCall> GetModuleCalls();

template <class THandle>
THandle FModulePlay::Handle(const char* Name, const TPlayHandles<THandle>& Of)
{
	const uint8_t Byte = Choose();
	const auto Pick = [&](const std::vector<THandle>& From, size_t Index) {
		return From.empty() ? THandle::None : From[Index % From.size()];
	};
	if (Byte == 0 && !Of.Live.empty()) { return Of.Live.back(); }
	if (Byte >= 5) { return Pick(Of.Live, Byte); }
	Wrong.emplace_back(Name);
	if (Byte == 2) { return Pick(Of.Stale, 0); }
	if (Byte == 3) { return Pick(Of.Foreign, 0); }
	return Byte == 4 ? static_cast<THandle>(0xDEADBEEFDEADBEEF) : THandle::None;
}

template <class THandle>
void FModulePlay::Keep(TPlayHandles<THandle>& Of, THandle Handle)
{
	if (Handle != THandle::None) { Of.Live.push_back(Handle); }
}

template <class THandle>
void FModulePlay::Forget(TPlayHandles<THandle>& Of, THandle Handle)
{
	if (std::erase(Of.Live, Handle) > 0) { Of.Stale.insert(Of.Stale.begin(), Handle); }
}

} // namespace Lantern
