#!/usr/bin/env python3
"""MFCC reference vectors at fs = 1000 Hz.  Input: 1 s signal from a portable LCG (see a_ar/ar_ref.py) + 3 sines.
Writes input.csv, <preset>.csv (frames x 13), filterbank CSVs and summary.json; proves that one 60-line generic routine reproduces
python_speech_features and librosa."""
import json, os, sys, numpy as np, warnings; warnings.filterwarnings('ignore')
HERE=os.path.dirname(os.path.abspath(__file__)); sys.path.insert(0,HERE+'/../a_ar')
from ar_ref import lcg_noise
import python_speech_features as psf, librosa
fs=1000
t=np.arange(fs)/fs
x=0.8*np.sin(2*np.pi*37*t)+0.5*np.sin(2*np.pi*121*t+.3)+0.3*np.sin(2*np.pi*263*t+1.1)+0.2*lcg_noise(fs,4242)
np.savetxt(HERE+'/input.csv',x,fmt='%.17g')
htk=lambda f:2595*np.log10(1+np.asarray(f)/700.); ihtk=lambda m:700*(10**(np.asarray(m)/2595)-1)
def slaney(f):
    f=np.asarray(f,float); return np.where(f<1000,f/(200/3),15+np.log(np.maximum(f,1e-9)/1000)/(np.log(6.4)/27))
def islaney(m):
    m=np.asarray(m,float); return np.where(m<15,m*200/3,1000*np.exp((m-15)*np.log(6.4)/27))
def fb_psf(M,nfft,lo,hi):
    b=np.floor((nfft+1)*ihtk(np.linspace(htk(lo),htk(hi),M+2))/fs); H=np.zeros((M,nfft//2+1)); k=np.arange(nfft//2+1)
    for j in range(M):
        l,c,r=b[j:j+3]
        H[j]=np.where((k>=l)&(k<c),(k-l)/max(c-l,1),np.where((k>=c)&(k<r),(r-k)/max(r-c,1),0))
    return H
def fb_cont(M,nfft,lo,hi,mel,imel,norm):
    f=np.arange(nfft//2+1)*fs/nfft; e=imel(np.linspace(mel(lo),mel(hi),M+2)); H=np.zeros((M,len(f)))
    for j in range(M):
        l,c,r=e[j:j+3]; H[j]=np.maximum(0,np.minimum((f-l)/(c-l),(r-f)/(r-c)))
        if norm: H[j]*=2/(r-l)
    return H
def dct2(L,n,ortho=True):
    M=L.shape[1]; k=np.arange(n)[:,None]; m=np.arange(M)[None]
    C=np.sqrt(2/M)*np.cos(np.pi*k*(m+.5)/M); 
    if ortho: C[0]/=np.sqrt(2)
    return L@C.T
def frames(x,N,hop,pad_last):
    n=len(x); F=1+(int(np.ceil((n-N)/hop)) if pad_last else (n-N)//hop); xp=np.r_[x,np.zeros(max(0,(F-1)*hop+N-n))]
    return np.stack([xp[i*hop:i*hop+N] for i in range(F)])
def generic(x,N=25,hop=15,nfft=512,M=26,lo=10,hi=500,win=None,pre=0.,fb='psf',power=2,scale=None,logf='ln',ncep=13,lift=0,energy=False,pad_last=True,ortho=True,eps=np.finfo(float).eps):
    y=np.r_[x[0],x[1:]-pre*x[:-1]] if pre else x
    Fm=frames(y,N,hop,pad_last)*(np.ones(N) if win is None else win)
    S=np.abs(np.fft.rfft(Fm,nfft))**power
    if scale: S=S*scale
    H={'psf':lambda:fb_psf(M,nfft,lo,hi),'htk':lambda:fb_cont(M,nfft,lo,hi,htk,ihtk,False),'slaney':lambda:fb_cont(M,nfft,lo,hi,slaney,islaney,True),'htknorm':lambda:fb_cont(M,nfft,lo,hi,htk,ihtk,True)}[fb]()
    B=S@H.T
    if logf=='ln': L=np.log(np.where(B==0,eps,B))
    else:
        L=10*np.log10(np.maximum(1e-10,B)); L=np.maximum(L,L.max()-80)
    C=dct2(L,ncep,ortho)
    if lift: C=C*(1+lift/2*np.sin(np.pi*np.arange(ncep)/lift))
    if energy: C[:,0]=np.log(S.sum(1))
    return C,H
def lib(y,nfft,M,htk,norm,lifter=0):
    P=librosa.feature.melspectrogram(y=y,sr=fs,n_fft=nfft,win_length=25,hop_length=15,center=False,n_mels=M,fmin=10,fmax=500,window='hann',power=2.0,htk=htk,norm=norm)
    return librosa.feature.mfcc(S=librosa.power_to_db(P),n_mfcc=13,dct_type=2,norm='ortho',lifter=lifter).T
def save(n,C): np.savetxt(f'{HERE}/{n}.csv',C,delimiter=',',fmt='%.12g')
S={}
ham=0.54-0.46*np.cos(2*np.pi*np.arange(25)/24)     # numpy.hamming(25) (symmetric)
hann_p=0.5-0.5*np.cos(2*np.pi*np.arange(25)/25)    # periodic Hann (librosa)
# 1/2 python_speech_features, library call and generic
A=psf.mfcc(x,fs,winlen=.025,winstep=.015,numcep=13,nfilt=26,nfft=512,lowfreq=10,highfreq=500,preemph=.97,ceplifter=22,appendEnergy=True)
B,H=generic(x,pre=.97,scale=1/512,lift=22,energy=True); S['psf_default_hop15']=dict(shape=A.shape,max_abs_diff_generic=float(np.abs(A-B).max()),row0=A[0].tolist()); save('psf_default_hop15',A); np.savetxt(HERE+'/fb_psf_26_512.csv',H,delimiter=',',fmt='%.8g')
A=psf.mfcc(x,fs,winlen=.025,winstep=.010,numcep=13,nfilt=26,nfft=512,lowfreq=10,highfreq=500,preemph=.97,ceplifter=22,appendEnergy=True)
B,_=generic(x,hop=10,pre=.97,scale=1/512,lift=22,energy=True); S['psf_default_hop10']=dict(shape=A.shape,max_abs_diff_generic=float(np.abs(A-B).max()),row0=A[0].tolist()); save('psf_default_hop10',A)
A=psf.mfcc(x,fs,winlen=.025,winstep=.015,numcep=13,nfilt=20,nfft=64,lowfreq=10,highfreq=500,preemph=0,ceplifter=0,appendEnergy=False,winfunc=np.hamming)
B,H=generic(x,nfft=64,M=20,win=ham,scale=1/64); S['psf_plain_hamming_20_64']=dict(shape=A.shape,max_abs_diff_generic=float(np.abs(A-B).max()),empty_filters=int((H.sum(1)==0).sum()),row0=A[0].tolist()); save('psf_plain_hamming_20_64',A)
# 3 librosa: explicit frames so that framing is unambiguous (center=False, frame_length = win_length = n_fft = 25)
for nm,kw,fbk in (('librosa_slaney_nfft25',dict(htk=False,norm='slaney'),'slaney'),('librosa_htk_nonorm_nfft25',dict(htk=True,norm=None),'htk')):
    A=lib(x,25,13,**kw)
    B,H=generic(x,nfft=25,M=13,win=hann_p,fb=fbk,logf='db',pad_last=False); S[nm]=dict(shape=A.shape,max_abs_diff_generic=float(np.abs(A-B).max()),empty_filters=int((H.sum(1)==0).sum()),row0=A[0].tolist()); save(nm,A)
# 4 librosa with zero padding to 512: window is centred in the 512 frame, so frame i starts at sample 15 i + 243 of the (padded) signal
A=lib(np.r_[np.zeros(243),x,np.zeros(244)],512,26,False,'slaney')
B,H=generic(x,nfft=512,M=26,win=hann_p,fb='slaney',logf='db',pad_last=False); n=min(len(A),len(B)); S['librosa_slaney_26_512']=dict(shape=A.shape,max_abs_diff_generic=float(np.abs(A[:n]-B[:n]).max()),empty_filters=int((H.sum(1)==0).sum()),row0=A[0].tolist()); save('librosa_slaney_26_512',A[:n]); np.savetxt(HERE+'/fb_librosa_slaney_26_512.csv',H,delimiter=',',fmt='%.8g')
A=lib(np.r_[np.zeros(243),x,np.zeros(244)],512,26,True,None,22)
B,_=generic(x,nfft=512,M=26,win=hann_p,fb='htk',logf='db',pad_last=False); B=B*(1+11*np.sin(np.pi*np.arange(1,14)/22)); S['librosa_htk_26_512_lifter22']=dict(max_abs_diff_generic=float(np.abs(A[:n]-B[:n]).max()),row0=A[0].tolist()); save('librosa_htk_26_512_lifter22',A[:n])
# 5 HTK-style MATLAB script constants: magnitude (not power), nfft = nextpow2, DCT row 0 not divided by sqrt 2, x 2^15 if peak <= 1
for M in (20,16,13):
    H=fb_cont(M,32,10,500,htk,ihtk,False); S[f'matlab_htk_nfft32_M{M}_empty_filters']=int((H.sum(1)==0).sum())
for nf in (32,64,128,256,512):
    for M in (13,20,26): S[f'empty_filters_htk_nfft{nf}_M{M}']=int((fb_cont(M,nf,10,500,htk,ihtk,False).sum(1)==0).sum()); S[f'empty_filters_psf_nfft{nf}_M{M}']=int((fb_psf(M,nf,10,500).sum(1)==0).sum())
# 6 recommended preset: Hamming 25, hop 15, nfft 64, power/N, HTK mel continuous triangles, M=20, natural log with floor 1e-12, ortho DCT, no lifter, no pre-emphasis
R,H=generic(x,nfft=64,M=20,win=ham,scale=1/64,fb='htk',pad_last=False,eps=1e-12); S['recommended']=dict(shape=R.shape,row0=R[0].tolist(),row1=R[1].tolist(),mean=R.mean(0).tolist(),empty=int((H.sum(1)==0).sum())); save('recommended_htk20_64_hop15',R); np.savetxt(HERE+'/fb_recommended_htk20_64.csv',H,delimiter=',',fmt='%.10g')
S['mel_points']=dict(htk_10=float(htk(10)),htk_500=float(htk(500)),slaney_10=float(slaney(10)),slaney_500=float(slaney(500)))
S['mel_edges_htk_M20']=ihtk(np.linspace(htk(10),htk(500),22)).tolist()
S['frames_25000']={'hop15_no_pad':1+(25000-25)//15,'hop15_psf_pad':1+int(np.ceil((25000-25)/15)),'hop10_no_pad':1+(25000-25)//10,'per_1s_pattern_hop15':1+(1000-25)//15,'per_1s_pattern_hop10':1+(1000-25)//10}
json.dump(S,open(HERE+'/summary.json','w'),indent=1)
for k,v in S.items():
    print(k, {a:(b if not isinstance(b,list) else np.round(b,4).tolist()[:5]) for a,b in v.items()} if isinstance(v,dict) else v)
