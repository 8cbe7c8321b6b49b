function F(i,e={},...t){let n=document.createElement(i);for(let[s,r]of Object.entries(e))r==null||r===!1||(s.startsWith("on")?n.addEventListener(s.slice(2),r):n.setAttribute(s,r===!0?"":String(r)));return n.append(...t.filter(s=>s!=null&&s!==!1).map(s=>typeof s=="number"?String(s):s)),n}function et(i,e){i.textContent!==e&&(i.textContent=e)}function jt(i){return getComputedStyle(document.documentElement).getPropertyValue(i).trim()}function Rn(i){return document.getElementById(i)}var Ct={device:0,flags:1,time:1,host:2,sequence:3,quat:8,rate:12,sigma:15,gyr:18,acc:21,mag:24,method:108,valid:109,tip:110,flagsSince:28},ll=["unknown","upright","leaning","tipping","fallen","free fall","picked up","righted"];var Rs=new Set([3,4,5]);var Cs=180/Math.PI;function Qs(i,e){let t=i.value(e,Ct.quat),n=i.value(e,Ct.quat+1),s=i.value(e,Ct.quat+2),r=i.value(e,Ct.quat+3),o=2*(n*s-t*r),a=1-2*(n*n+r*r),l=2*(s*r+t*n),c=2*(n*r-t*s),h=2*(n*r+t*s),d=2*(s*r-t*n),u=1-2*(n*n+s*s),f=Math.atan2(o,a),p=f*Cs,x=i.value(e,Ct.sigma)*Cs,m=i.value(e,Ct.sigma+1)*Cs,g=Math.sin(f),S=Math.cos(f),T=Math.hypot(h,d),y=i.value(e,Ct.sigma+2)*Cs,C=Math.hypot(n,s,r),[A,v]=T>1e-6?[h/T,d/T]:[Math.SQRT1_2,Math.SQRT1_2];return{heading:p<0?p+360:p,pitch:Math.asin(Math.max(-1,Math.min(1,l)))*Cs,roll:Math.atan2(-c,u)*Cs,tilt:Math.atan2(T,u)*Cs,turn:-p,angle:2*Math.atan2(C,Math.abs(t))*Cs,sigmaHeading:y,sigmaPitch:Math.hypot(x*S,m*g),sigmaRoll:Math.hypot(x*g,m*S),sigmaTilt:Math.hypot(x*v,m*A),sigmaAngle:C>.001?Math.hypot(n*x,s*m,r*y)/C:Math.hypot(x,m,y)/Math.sqrt(3)}}function en(i,e){return Number.isFinite(i)?i.toFixed(e).replace(/^-(0(\.0*)?)$/,"$1").replace("-","\u2212"):"\u2013"}var im=0,od=1,sm=2;var Da=1,rm=2,mo=3,Hs=0,Kn=1,ci=2,hr=0,go=1,ad=2,ld=3,cd=4,om=5;var ur=100,am=101,lm=102,cm=103,hm=104,um=200,dm=201,fm=202,pm=203,hd=204,ud=205,mm=206,gm=207,_m=208,vm=209,xm=210,ym=211,Sm=212,Mm=213,bm=214,Gl=0,Vl=1,Wl=2,eo=3,Xl=4,ql=5,Yl=6,$l=7,Rc=0,wm=1,Em=2,Ki=0,dd=1,fd=2,pd=3,md=4,gd=5,_d=6,vd=7;var xd=300,dr=301,_o=302,Cc=303,Pc=304,Zl=1e3,qi=1001,Jl=1002,Pn=1003,Tm=1004;var Na=1005;var Zn=1006,Ic=1007;var _s=1008;var jn=1009,yd=1010,Sd=1011,vo=1012,Lc=1013,Ci=1014,Pi=1015,Ii=1016,Dc=1017,Nc=1018,fr=1020,Md=35902,bd=35899,wd=1021,Ed=1022,Li=1023,fs=1026,vs=1027,Td=1028,Uc=1029,Gs=1030,Fc=1031;var Oc=1033,Ua=33776,Fa=33777,Oa=33778,Ba=33779,Bc=35840,kc=35841,zc=35842,Hc=35843,Gc=36196,Vc=37492,Wc=37496,Xc=37488,qc=37489,ka=37490,Yc=37491,$c=37808,Zc=37809,Jc=37810,Kc=37811,Qc=37812,jc=37813,eh=37814,th=37815,nh=37816,ih=37817,sh=37818,rh=37819,oh=37820,ah=37821,lh=36492,ch=36494,hh=36495,uh=36283,dh=36284,za=36285,fh=36286;var na=2300,Kl=2301,kl=2302,Zu=2303,Ju=2400,Ku=2401,Qu=2402;var Am=3200;var ph=0,Rm=1,xs="",$n="srgb",ia="srgb-linear",sa="linear",Ut="srgb";var zl=7680;var Cm=519,Pm=512,Im=513,Lm=514,Ad=515,Dm=516,Nm=517,Rd=518,Cd=519,Pd=35044,Id=35048;var Ld="300 es",gi=2e3,to=2001;function G_(i){for(let e=i.length-1;e>=0;--e)if(i[e]>=65535)return!0;return!1}function V_(i){return ArrayBuffer.isView(i)&&!(i instanceof DataView)}function ra(i){return document.createElementNS("http://www.w3.org/1999/xhtml",i)}function Um(){let i=ra("canvas");return i.style.display="block",i}var Sp={},no=null;function oa(...i){let e="THREE."+i.shift();no?no("log",e,...i):console.log(e,...i)}function Fm(i){let e=i[0];if(typeof e=="string"&&e.startsWith("TSL:")){let t=i[1];t&&t.isStackTrace?i[0]+=" "+t.getLocation():i[1]='Stack trace not available. Enable "THREE.Node.captureStackTrace" to capture stack traces.'}return i}function tt(...i){i=Fm(i);let e="THREE."+i.shift();if(no)no("warn",e,...i);else{let t=i[0];t&&t.isStackTrace?console.warn(t.getError(e)):console.warn(e,...i)}}function at(...i){i=Fm(i);let e="THREE."+i.shift();if(no)no("error",e,...i);else{let t=i[0];t&&t.isStackTrace?console.error(t.getError(e)):console.error(e,...i)}}function jo(...i){let e=i.join(" ");e in Sp||(Sp[e]=!0,tt(...i))}function Om(i,e,t){return new Promise(function(n,s){function r(){switch(i.clientWaitSync(e,i.SYNC_FLUSH_COMMANDS_BIT,0)){case i.WAIT_FAILED:s();break;case i.TIMEOUT_EXPIRED:setTimeout(r,t);break;default:n()}}setTimeout(r,t)})}var Bm={[Gl]:Gl,[Wl]:Yl,[Xl]:Xl,[eo]:ql,[Vl]:Vl,[Yl]:Wl,[$l]:$l,[ql]:eo},$i=class{addEventListener(e,t){this._listeners===void 0&&(this._listeners={});let n=this._listeners;n[e]===void 0&&(n[e]=[]),n[e].indexOf(t)===-1&&n[e].push(t)}hasEventListener(e,t){let n=this._listeners;return n===void 0?!1:n[e]!==void 0&&n[e].indexOf(t)!==-1}removeEventListener(e,t){let n=this._listeners;if(n===void 0)return;let s=n[e];if(s!==void 0){let r=s.indexOf(t);r!==-1&&s.splice(r,1)}}dispatchEvent(e){let t=this._listeners;if(t===void 0)return;let n=t[e.type];if(n!==void 0){e.target=this;let s=n.slice(0);for(let r=0,o=s.length;r<o;r++)s[r].call(this,e);e.target=null}}},On=["00","01","02","03","04","05","06","07","08","09","0a","0b","0c","0d","0e","0f","10","11","12","13","14","15","16","17","18","19","1a","1b","1c","1d","1e","1f","20","21","22","23","24","25","26","27","28","29","2a","2b","2c","2d","2e","2f","30","31","32","33","34","35","36","37","38","39","3a","3b","3c","3d","3e","3f","40","41","42","43","44","45","46","47","48","49","4a","4b","4c","4d","4e","4f","50","51","52","53","54","55","56","57","58","59","5a","5b","5c","5d","5e","5f","60","61","62","63","64","65","66","67","68","69","6a","6b","6c","6d","6e","6f","70","71","72","73","74","75","76","77","78","79","7a","7b","7c","7d","7e","7f","80","81","82","83","84","85","86","87","88","89","8a","8b","8c","8d","8e","8f","90","91","92","93","94","95","96","97","98","99","9a","9b","9c","9d","9e","9f","a0","a1","a2","a3","a4","a5","a6","a7","a8","a9","aa","ab","ac","ad","ae","af","b0","b1","b2","b3","b4","b5","b6","b7","b8","b9","ba","bb","bc","bd","be","bf","c0","c1","c2","c3","c4","c5","c6","c7","c8","c9","ca","cb","cc","cd","ce","cf","d0","d1","d2","d3","d4","d5","d6","d7","d8","d9","da","db","dc","dd","de","df","e0","e1","e2","e3","e4","e5","e6","e7","e8","e9","ea","eb","ec","ed","ee","ef","f0","f1","f2","f3","f4","f5","f6","f7","f8","f9","fa","fb","fc","fd","fe","ff"];var Hl=Math.PI/180,Ql=180/Math.PI;function Vs(){let i=Math.random()*4294967295|0,e=Math.random()*4294967295|0,t=Math.random()*4294967295|0,n=Math.random()*4294967295|0;return(On[i&255]+On[i>>8&255]+On[i>>16&255]+On[i>>24&255]+"-"+On[e&255]+On[e>>8&255]+"-"+On[e>>16&15|64]+On[e>>24&255]+"-"+On[t&63|128]+On[t>>8&255]+"-"+On[t>>16&255]+On[t>>24&255]+On[n&255]+On[n>>8&255]+On[n>>16&255]+On[n>>24&255]).toLowerCase()}function wt(i,e,t){return Math.max(e,Math.min(t,i))}function W_(i,e){return(i%e+e)%e}function Mu(i,e,t){return(1-t)*i+t*e}function km(i){return Math.pow(2,Math.floor(Math.log(i)/Math.LN2))}function mh(i){switch(i.constructor){case Uint32Array:return 4294967295;case Uint16Array:return 65535;case Uint8Array:case Uint8ClampedArray:return 255;case Int32Array:return 2147483647;case Int16Array:return 32767;case Int8Array:return 127;default:return}}function zm(i,e){if(e.constructor===Float32Array)return i;let t=mh(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.max(i/t,-1)}function Hm(i,e){if(e.constructor===Float32Array)return i;let t=mh(e);if(t===void 0)throw new Error("THREE.MathUtils: Invalid component type.");return Math.round(i*t)}var Bd=class Bd{constructor(e=0,t=0){this.x=e,this.y=t}get width(){return this.x}set width(e){this.x=e}get height(){return this.y}set height(e){this.y=e}set(e,t){return this.x=e,this.y=t,this}setScalar(e){return this.x=e,this.y=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;default:throw new Error("THREE.Vector2: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;default:throw new Error("THREE.Vector2: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y)}copy(e){return this.x=e.x,this.y=e.y,this}add(e){return this.x+=e.x,this.y+=e.y,this}addScalar(e){return this.x+=e,this.y+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this}subScalar(e){return this.x-=e,this.y-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this}multiply(e){return this.x*=e.x,this.y*=e.y,this}multiplyScalar(e){return this.x*=e,this.y*=e,this}divide(e){return this.x/=e.x,this.y/=e.y,this}divideScalar(e){return this.multiplyScalar(1/e)}applyMatrix3(e){let t=this.x,n=this.y,s=e.elements;return this.x=s[0]*t+s[3]*n+s[6],this.y=s[1]*t+s[4]*n+s[7],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this}clamp(e,t){return this.x=wt(this.x,e.x,t.x),this.y=wt(this.y,e.y,t.y),this}clampScalar(e,t){return this.x=wt(this.x,e,t),this.y=wt(this.y,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(wt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this}negate(){return this.x=-this.x,this.y=-this.y,this}dot(e){return this.x*e.x+this.y*e.y}cross(e){return this.x*e.y-this.y*e.x}lengthSq(){return this.x*this.x+this.y*this.y}length(){return Math.sqrt(this.x*this.x+this.y*this.y)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)}normalize(){return this.divideScalar(this.length()||1)}angle(){return Math.atan2(-this.y,-this.x)+Math.PI}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(wt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y;return t*t+n*n}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this}equals(e){return e.x===this.x&&e.y===this.y}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this}rotateAround(e,t){let n=Math.cos(t),s=Math.sin(t),r=this.x-e.x,o=this.y-e.y;return this.x=r*n-o*s+e.x,this.y=r*s+o*n+e.y,this}random(){return this.x=Math.random(),this.y=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y}};Bd.prototype.isVector2=!0;var De=Bd,_i=class{constructor(e=0,t=0,n=0,s=1){this.isQuaternion=!0,this._x=e,this._y=t,this._z=n,this._w=s}static slerpFlat(e,t,n,s,r,o,a){let l=n[s+0],c=n[s+1],h=n[s+2],d=n[s+3],u=r[o+0],f=r[o+1],p=r[o+2],x=r[o+3];if(d!==x||l!==u||c!==f||h!==p){let m=l*u+c*f+h*p+d*x;m<0&&(u=-u,f=-f,p=-p,x=-x,m=-m);let g=1-a;if(m<.9995){let S=Math.acos(m),T=Math.sin(S);g=Math.sin(g*S)/T,a=Math.sin(a*S)/T,l=l*g+u*a,c=c*g+f*a,h=h*g+p*a,d=d*g+x*a}else{l=l*g+u*a,c=c*g+f*a,h=h*g+p*a,d=d*g+x*a;let S=1/Math.sqrt(l*l+c*c+h*h+d*d);l*=S,c*=S,h*=S,d*=S}}e[t]=l,e[t+1]=c,e[t+2]=h,e[t+3]=d}static multiplyQuaternionsFlat(e,t,n,s,r,o){let a=n[s],l=n[s+1],c=n[s+2],h=n[s+3],d=r[o],u=r[o+1],f=r[o+2],p=r[o+3];return e[t]=a*p+h*d+l*f-c*u,e[t+1]=l*p+h*u+c*d-a*f,e[t+2]=c*p+h*f+a*u-l*d,e[t+3]=h*p-a*d-l*u-c*f,e}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get w(){return this._w}set w(e){this._w=e,this._onChangeCallback()}set(e,t,n,s){return this._x=e,this._y=t,this._z=n,this._w=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._w)}copy(e){return this._x=e.x,this._y=e.y,this._z=e.z,this._w=e.w,this._onChangeCallback(),this}setFromEuler(e,t=!0){let n=e._x,s=e._y,r=e._z,o=e._order,a=Math.cos,l=Math.sin,c=a(n/2),h=a(s/2),d=a(r/2),u=l(n/2),f=l(s/2),p=l(r/2);switch(o){case"XYZ":this._x=u*h*d+c*f*p,this._y=c*f*d-u*h*p,this._z=c*h*p+u*f*d,this._w=c*h*d-u*f*p;break;case"YXZ":this._x=u*h*d+c*f*p,this._y=c*f*d-u*h*p,this._z=c*h*p-u*f*d,this._w=c*h*d+u*f*p;break;case"ZXY":this._x=u*h*d-c*f*p,this._y=c*f*d+u*h*p,this._z=c*h*p+u*f*d,this._w=c*h*d-u*f*p;break;case"ZYX":this._x=u*h*d-c*f*p,this._y=c*f*d+u*h*p,this._z=c*h*p-u*f*d,this._w=c*h*d+u*f*p;break;case"YZX":this._x=u*h*d+c*f*p,this._y=c*f*d+u*h*p,this._z=c*h*p-u*f*d,this._w=c*h*d-u*f*p;break;case"XZY":this._x=u*h*d-c*f*p,this._y=c*f*d-u*h*p,this._z=c*h*p+u*f*d,this._w=c*h*d+u*f*p;break;default:tt("Quaternion: .setFromEuler() encountered an unknown order: "+o)}return t===!0&&this._onChangeCallback(),this}setFromAxisAngle(e,t){let n=t/2,s=Math.sin(n);return this._x=e.x*s,this._y=e.y*s,this._z=e.z*s,this._w=Math.cos(n),this._onChangeCallback(),this}setFromRotationMatrix(e){let t=e.elements,n=t[0],s=t[4],r=t[8],o=t[1],a=t[5],l=t[9],c=t[2],h=t[6],d=t[10],u=n+a+d;if(u>0){let f=.5/Math.sqrt(u+1);this._w=.25/f,this._x=(h-l)*f,this._y=(r-c)*f,this._z=(o-s)*f}else if(n>a&&n>d){let f=2*Math.sqrt(1+n-a-d);this._w=(h-l)/f,this._x=.25*f,this._y=(s+o)/f,this._z=(r+c)/f}else if(a>d){let f=2*Math.sqrt(1+a-n-d);this._w=(r-c)/f,this._x=(s+o)/f,this._y=.25*f,this._z=(l+h)/f}else{let f=2*Math.sqrt(1+d-n-a);this._w=(o-s)/f,this._x=(r+c)/f,this._y=(l+h)/f,this._z=.25*f}return this._onChangeCallback(),this}setFromUnitVectors(e,t){let n=e.dot(t)+1;return n<1e-8?(n=0,Math.abs(e.x)>Math.abs(e.z)?(this._x=-e.y,this._y=e.x,this._z=0,this._w=n):(this._x=0,this._y=-e.z,this._z=e.y,this._w=n)):(this._x=e.y*t.z-e.z*t.y,this._y=e.z*t.x-e.x*t.z,this._z=e.x*t.y-e.y*t.x,this._w=n),this.normalize()}angleTo(e){return 2*Math.acos(Math.abs(wt(this.dot(e),-1,1)))}rotateTowards(e,t){let n=this.angleTo(e);if(n===0)return this;let s=Math.min(1,t/n);return this.slerp(e,s),this}identity(){return this.set(0,0,0,1)}invert(){return this.conjugate()}conjugate(){return this._x*=-1,this._y*=-1,this._z*=-1,this._onChangeCallback(),this}dot(e){return this._x*e._x+this._y*e._y+this._z*e._z+this._w*e._w}lengthSq(){return this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w}length(){return Math.sqrt(this._x*this._x+this._y*this._y+this._z*this._z+this._w*this._w)}normalize(){let e=this.length();return e===0?(this._x=0,this._y=0,this._z=0,this._w=1):(e=1/e,this._x=this._x*e,this._y=this._y*e,this._z=this._z*e,this._w=this._w*e),this._onChangeCallback(),this}multiply(e){return this.multiplyQuaternions(this,e)}premultiply(e){return this.multiplyQuaternions(e,this)}multiplyQuaternions(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=t._x,l=t._y,c=t._z,h=t._w;return this._x=n*h+o*a+s*c-r*l,this._y=s*h+o*l+r*a-n*c,this._z=r*h+o*c+n*l-s*a,this._w=o*h-n*a-s*l-r*c,this._onChangeCallback(),this}slerp(e,t){let n=e._x,s=e._y,r=e._z,o=e._w,a=this.dot(e);a<0&&(n=-n,s=-s,r=-r,o=-o,a=-a);let l=1-t;if(a<.9995){let c=Math.acos(a),h=Math.sin(c);l=Math.sin(l*c)/h,t=Math.sin(t*c)/h,this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this._onChangeCallback()}else this._x=this._x*l+n*t,this._y=this._y*l+s*t,this._z=this._z*l+r*t,this._w=this._w*l+o*t,this.normalize();return this}slerpQuaternions(e,t,n){return this.copy(e).slerp(t,n)}random(){let e=2*Math.PI*Math.random(),t=2*Math.PI*Math.random(),n=Math.random(),s=Math.sqrt(1-n),r=Math.sqrt(n);return this.set(s*Math.sin(e),s*Math.cos(e),r*Math.sin(t),r*Math.cos(t))}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._w===this._w}fromArray(e,t=0){return this._x=e[t],this._y=e[t+1],this._z=e[t+2],this._w=e[t+3],this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._w,e}fromBufferAttribute(e,t){return this._x=e.getX(t),this._y=e.getY(t),this._z=e.getZ(t),this._w=e.getW(t),this._onChangeCallback(),this}toJSON(){return this.toArray()}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._w}},kd=class kd{constructor(e=0,t=0,n=0){this.x=e,this.y=t,this.z=n}set(e,t,n){return n===void 0&&(n=this.z),this.x=e,this.y=t,this.z=n,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;default:throw new Error("THREE.Vector3: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;default:throw new Error("THREE.Vector3: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this}multiplyVectors(e,t){return this.x=e.x*t.x,this.y=e.y*t.y,this.z=e.z*t.z,this}applyEuler(e){return this.applyQuaternion(Mp.setFromEuler(e))}applyAxisAngle(e,t){return this.applyQuaternion(Mp.setFromAxisAngle(e,t))}applyMatrix3(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[3]*n+r[6]*s,this.y=r[1]*t+r[4]*n+r[7]*s,this.z=r[2]*t+r[5]*n+r[8]*s,this}applyNormalMatrix(e){return this.applyMatrix3(e).normalize()}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=e.elements,o=1/(r[3]*t+r[7]*n+r[11]*s+r[15]);return this.x=(r[0]*t+r[4]*n+r[8]*s+r[12])*o,this.y=(r[1]*t+r[5]*n+r[9]*s+r[13])*o,this.z=(r[2]*t+r[6]*n+r[10]*s+r[14])*o,this}applyQuaternion(e){let t=this.x,n=this.y,s=this.z,r=e.x,o=e.y,a=e.z,l=e.w,c=2*(o*s-a*n),h=2*(a*t-r*s),d=2*(r*n-o*t);return this.x=t+l*c+o*d-a*h,this.y=n+l*h+a*c-r*d,this.z=s+l*d+r*h-o*c,this}project(e){return this.applyMatrix4(e.matrixWorldInverse).applyMatrix4(e.projectionMatrix)}unproject(e){return this.applyMatrix4(e.projectionMatrixInverse).applyMatrix4(e.matrixWorld)}transformDirection(e){let t=this.x,n=this.y,s=this.z,r=e.elements;return this.x=r[0]*t+r[4]*n+r[8]*s,this.y=r[1]*t+r[5]*n+r[9]*s,this.z=r[2]*t+r[6]*n+r[10]*s,this.normalize()}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this}divideScalar(e){return this.multiplyScalar(1/e)}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this}clamp(e,t){return this.x=wt(this.x,e.x,t.x),this.y=wt(this.y,e.y,t.y),this.z=wt(this.z,e.z,t.z),this}clampScalar(e,t){return this.x=wt(this.x,e,t),this.y=wt(this.y,e,t),this.z=wt(this.z,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(wt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this}cross(e){return this.crossVectors(this,e)}crossVectors(e,t){let n=e.x,s=e.y,r=e.z,o=t.x,a=t.y,l=t.z;return this.x=s*l-r*a,this.y=r*o-n*l,this.z=n*a-s*o,this}projectOnVector(e){let t=e.lengthSq();if(t===0)return this.set(0,0,0);let n=e.dot(this)/t;return this.copy(e).multiplyScalar(n)}projectOnPlane(e){return bu.copy(this).projectOnVector(e),this.sub(bu)}reflect(e){return this.sub(bu.copy(e).multiplyScalar(2*this.dot(e)))}angleTo(e){let t=Math.sqrt(this.lengthSq()*e.lengthSq());if(t===0)return Math.PI/2;let n=this.dot(e)/t;return Math.acos(wt(n,-1,1))}distanceTo(e){return Math.sqrt(this.distanceToSquared(e))}distanceToSquared(e){let t=this.x-e.x,n=this.y-e.y,s=this.z-e.z;return t*t+n*n+s*s}manhattanDistanceTo(e){return Math.abs(this.x-e.x)+Math.abs(this.y-e.y)+Math.abs(this.z-e.z)}setFromSpherical(e){return this.setFromSphericalCoords(e.radius,e.phi,e.theta)}setFromSphericalCoords(e,t,n){let s=Math.sin(t)*e;return this.x=s*Math.sin(n),this.y=Math.cos(t)*e,this.z=s*Math.cos(n),this}setFromCylindrical(e){return this.setFromCylindricalCoords(e.radius,e.theta,e.y)}setFromCylindricalCoords(e,t,n){return this.x=e*Math.sin(t),this.y=n,this.z=e*Math.cos(t),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this}setFromMatrixScale(e){let t=this.setFromMatrixColumn(e,0).length(),n=this.setFromMatrixColumn(e,1).length(),s=this.setFromMatrixColumn(e,2).length();return this.x=t,this.y=n,this.z=s,this}setFromMatrixColumn(e,t){return this.fromArray(e.elements,t*4)}setFromMatrix3Column(e,t){return this.fromArray(e.elements,t*3)}setFromEuler(e){return this.x=e._x,this.y=e._y,this.z=e._z,this}setFromColor(e){return this.x=e.r,this.y=e.g,this.z=e.b,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this}randomDirection(){let e=Math.random()*Math.PI*2,t=Math.random()*2-1,n=Math.sqrt(1-t*t);return this.x=n*Math.cos(e),this.y=t,this.z=n*Math.sin(e),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z}};kd.prototype.isVector3=!0;var X=kd,bu=new X,Mp=new _i,zd=class zd{constructor(e,t,n,s,r,o,a,l,c){this.elements=[1,0,0,0,1,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c)}set(e,t,n,s,r,o,a,l,c){let h=this.elements;return h[0]=e,h[1]=s,h[2]=a,h[3]=t,h[4]=r,h[5]=l,h[6]=n,h[7]=o,h[8]=c,this}identity(){return this.set(1,0,0,0,1,0,0,0,1),this}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],this}extractBasis(e,t,n){return e.setFromMatrix3Column(this,0),t.setFromMatrix3Column(this,1),n.setFromMatrix3Column(this,2),this}setFromMatrix4(e){let t=e.elements;return this.set(t[0],t[4],t[8],t[1],t[5],t[9],t[2],t[6],t[10]),this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[3],l=n[6],c=n[1],h=n[4],d=n[7],u=n[2],f=n[5],p=n[8],x=s[0],m=s[3],g=s[6],S=s[1],T=s[4],y=s[7],C=s[2],A=s[5],v=s[8];return r[0]=o*x+a*S+l*C,r[3]=o*m+a*T+l*A,r[6]=o*g+a*y+l*v,r[1]=c*x+h*S+d*C,r[4]=c*m+h*T+d*A,r[7]=c*g+h*y+d*v,r[2]=u*x+f*S+p*C,r[5]=u*m+f*T+p*A,r[8]=u*g+f*y+p*v,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[3]*=e,t[6]*=e,t[1]*=e,t[4]*=e,t[7]*=e,t[2]*=e,t[5]*=e,t[8]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8];return t*o*h-t*a*c-n*r*h+n*a*l+s*r*c-s*o*l}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],d=h*o-a*c,u=a*l-h*r,f=c*r-o*l,p=t*d+n*u+s*f;if(p===0)return this.set(0,0,0,0,0,0,0,0,0);let x=1/p;return e[0]=d*x,e[1]=(s*c-h*n)*x,e[2]=(a*n-s*o)*x,e[3]=u*x,e[4]=(h*t-s*l)*x,e[5]=(s*r-a*t)*x,e[6]=f*x,e[7]=(n*l-c*t)*x,e[8]=(o*t-n*r)*x,this}transpose(){let e,t=this.elements;return e=t[1],t[1]=t[3],t[3]=e,e=t[2],t[2]=t[6],t[6]=e,e=t[5],t[5]=t[7],t[7]=e,this}getNormalMatrix(e){return this.setFromMatrix4(e).invert().transpose()}transposeIntoArray(e){let t=this.elements;return e[0]=t[0],e[1]=t[3],e[2]=t[6],e[3]=t[1],e[4]=t[4],e[5]=t[7],e[6]=t[2],e[7]=t[5],e[8]=t[8],this}setUvTransform(e,t,n,s,r,o,a){let l=Math.cos(r),c=Math.sin(r);return this.set(n*l,n*c,-n*(l*o+c*a)+o+e,-s*c,s*l,-s*(-c*o+l*a)+a+t,0,0,1),this}scale(e,t){return jo("Matrix3: .scale() is deprecated. Use .makeScale() instead."),this.premultiply(wu.makeScale(e,t)),this}rotate(e){return jo("Matrix3: .rotate() is deprecated. Use .makeRotation() instead."),this.premultiply(wu.makeRotation(-e)),this}translate(e,t){return jo("Matrix3: .translate() is deprecated. Use .makeTranslation() instead."),this.premultiply(wu.makeTranslation(e,t)),this}makeTranslation(e,t){return e.isVector2?this.set(1,0,e.x,0,1,e.y,0,0,1):this.set(1,0,e,0,1,t,0,0,1),this}makeRotation(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,n,t,0,0,0,1),this}makeScale(e,t){return this.set(e,0,0,0,t,0,0,0,1),this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<9;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<9;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e}clone(){return new this.constructor().fromArray(this.elements)}};zd.prototype.isMatrix3=!0;var ft=zd,wu=new ft,bp=new ft().set(.4123908,.3575843,.1804808,.212639,.7151687,.0721923,.0193308,.1191948,.9505322),wp=new ft().set(3.2409699,-1.5373832,-.4986108,-.9692436,1.8759675,.0415551,.0556301,-.203977,1.0569715);function X_(){let i={enabled:!0,workingColorSpace:ia,spaces:{},convert:function(s,r,o){return this.enabled===!1||r===o||!r||!o||(this.spaces[r].transfer===Ut&&(s.r=ds(s.r),s.g=ds(s.g),s.b=ds(s.b)),this.spaces[r].primaries!==this.spaces[o].primaries&&(s.applyMatrix3(this.spaces[r].toXYZ),s.applyMatrix3(this.spaces[o].fromXYZ)),this.spaces[o].transfer===Ut&&(s.r=jr(s.r),s.g=jr(s.g),s.b=jr(s.b))),s},workingToColorSpace:function(s,r){return this.convert(s,this.workingColorSpace,r)},colorSpaceToWorking:function(s,r){return this.convert(s,r,this.workingColorSpace)},getPrimaries:function(s){return this.spaces[s].primaries},getTransfer:function(s){return s===xs?sa:this.spaces[s].transfer},getToneMappingMode:function(s){return this.spaces[s].outputColorSpaceConfig.toneMappingMode||"standard"},getLuminanceCoefficients:function(s,r=this.workingColorSpace){return s.fromArray(this.spaces[r].luminanceCoefficients)},define:function(s){Object.assign(this.spaces,s)},_getMatrix:function(s,r,o){return s.copy(this.spaces[o].fromXYZ).multiply(this.spaces[r].toXYZ)},_getDrawingBufferColorSpace:function(s){return this.spaces[s].outputColorSpaceConfig.drawingBufferColorSpace},_getUnpackColorSpace:function(s=this.workingColorSpace){return this.spaces[s].workingColorSpaceConfig.unpackColorSpace}},e=[.64,.33,.3,.6,.15,.06],t=[.2126,.7152,.0722],n=[.3127,.329];return i.define({[ia]:{primaries:e,whitePoint:n,transfer:sa,toXYZ:bp,fromXYZ:wp,luminanceCoefficients:t,workingColorSpaceConfig:{unpackColorSpace:$n},outputColorSpaceConfig:{drawingBufferColorSpace:$n}},[$n]:{primaries:e,whitePoint:n,transfer:Ut,toXYZ:bp,fromXYZ:wp,luminanceCoefficients:t,outputColorSpaceConfig:{drawingBufferColorSpace:$n}}}),i}var Tt=X_();function ds(i){return i<.04045?i*.0773993808:Math.pow(i*.9478672986+.0521327014,2.4)}function jr(i){return i<.0031308?i*12.92:1.055*Math.pow(i,.41666)-.055}var Fr,jl=class{static getDataURL(e,t="image/png"){if(/^data:/i.test(e.src)||typeof HTMLCanvasElement>"u")return e.src;let n;if(e instanceof HTMLCanvasElement)n=e;else{Fr===void 0&&(Fr=ra("canvas")),Fr.width=e.width,Fr.height=e.height;let s=Fr.getContext("2d");e instanceof ImageData?s.putImageData(e,0,0):s.drawImage(e,0,0,e.width,e.height),n=Fr}return n.toDataURL(t)}static sRGBToLinear(e){if(typeof HTMLImageElement<"u"&&e instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&e instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&e instanceof ImageBitmap){let t=ra("canvas");t.width=e.width,t.height=e.height;let n=t.getContext("2d");n.drawImage(e,0,0,e.width,e.height);let s=n.getImageData(0,0,e.width,e.height),r=s.data;for(let o=0;o<r.length;o++)r[o]=ds(r[o]/255)*255;return n.putImageData(s,0,0),t}else if(e.data){let t=e.data.slice(0);for(let n=0;n<t.length;n++)t instanceof Uint8Array||t instanceof Uint8ClampedArray?t[n]=Math.floor(ds(t[n]/255)*255):t[n]=ds(t[n]);return{data:t,width:e.width,height:e.height}}else return tt("ImageUtils.sRGBToLinear(): Unsupported image type. No color space conversion applied."),e}},q_=0,io=class{constructor(e=null){this.isTextureSource=!0,Object.defineProperty(this,"id",{value:q_++}),this.uuid=Vs(),this.data=e,this.dataReady=!0,this.version=0}getSize(e){let t=this.data;return typeof HTMLVideoElement<"u"&&t instanceof HTMLVideoElement?e.set(t.videoWidth,t.videoHeight,0):typeof VideoFrame<"u"&&t instanceof VideoFrame?e.set(t.displayWidth,t.displayHeight,0):t!==null?e.set(t.width||0,t.height||0,t.depth||0):e.set(0,0,0),e}set needsUpdate(e){e===!0&&this.version++}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.images[this.uuid]!==void 0)return e.images[this.uuid];let n={uuid:this.uuid,url:""},s=this.data;if(s!==null){let r;if(Array.isArray(s)){r=[];for(let o=0,a=s.length;o<a;o++)s[o].isDataTexture?r.push(Eu(s[o].image)):r.push(Eu(s[o]))}else r=Eu(s);n.url=r}return t||(e.images[this.uuid]=n),n}};function Eu(i){return typeof HTMLImageElement<"u"&&i instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&i instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&i instanceof ImageBitmap?jl.getDataURL(i):i.data?{data:Array.from(i.data),width:i.width,height:i.height,type:i.data.constructor.name}:(tt("Texture: Unable to serialize Texture."),{})}var Y_=0,Tu=new X,Jn=class i extends $i{constructor(e=i.DEFAULT_IMAGE,t=i.DEFAULT_MAPPING,n=qi,s=qi,r=Zn,o=_s,a=Li,l=jn,c=i.DEFAULT_ANISOTROPY,h=xs){super(),this.isTexture=!0,Object.defineProperty(this,"id",{value:Y_++}),this.uuid=Vs(),this.name="",this.source=new io(e),this.mipmaps=[],this.mapping=t,this.channel=0,this.wrapS=n,this.wrapT=s,this.magFilter=r,this.minFilter=o,this.anisotropy=c,this.format=a,this.internalFormat=null,this.type=l,this.offset=new De(0,0),this.repeat=new De(1,1),this.center=new De(0,0),this.rotation=0,this.matrixAutoUpdate=!0,this.matrix=new ft,this.generateMipmaps=!0,this.mipmapsAutoUpdate=!0,this.premultiplyAlpha=!1,this.flipY=!0,this.unpackAlignment=4,this.colorSpace=h,this.userData={},this.updateRanges=[],this.version=0,this.onUpdate=null,this.renderTarget=null,this.isRenderTargetTexture=!1,this.isArrayTexture=!!(e&&e.depth&&e.depth>1),this.pmremVersion=0,this.isPMREMTexture=!1,this.normalized=!1}get width(){return this.source.getSize(Tu).x}get height(){return this.source.getSize(Tu).y}get depth(){return this.source.getSize(Tu).z}get image(){return this.source.data}set image(e){this.source.data=e}updateMatrix(){this.matrix.setUvTransform(this.offset.x,this.offset.y,this.repeat.x,this.repeat.y,this.rotation,this.center.x,this.center.y)}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}clone(){return new this.constructor().copy(this)}copy(e){return this.name=e.name,this.source=e.source,this.mipmaps=e.mipmaps.slice(0),this.mapping=e.mapping,this.channel=e.channel,this.wrapS=e.wrapS,this.wrapT=e.wrapT,this.magFilter=e.magFilter,this.minFilter=e.minFilter,this.anisotropy=e.anisotropy,this.format=e.format,this.internalFormat=e.internalFormat,this.type=e.type,this.normalized=e.normalized,this.offset.copy(e.offset),this.repeat.copy(e.repeat),this.center.copy(e.center),this.rotation=e.rotation,this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrix.copy(e.matrix),this.generateMipmaps=e.generateMipmaps,this.mipmapsAutoUpdate=e.mipmapsAutoUpdate,this.premultiplyAlpha=e.premultiplyAlpha,this.flipY=e.flipY,this.unpackAlignment=e.unpackAlignment,this.colorSpace=e.colorSpace,this.renderTarget=e.renderTarget,this.isRenderTargetTexture=e.isRenderTargetTexture,this.isPMREMTexture=e.isPMREMTexture,this.isArrayTexture=e.isArrayTexture,this.userData=JSON.parse(JSON.stringify(e.userData)),this.needsUpdate=!0,this}setValues(e){for(let t in e){let n=e[t];if(n===void 0){tt(`Texture.setValues(): parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){tt(`Texture.setValues(): property '${t}' does not exist.`);continue}s&&n&&s.isVector2&&n.isVector2||s&&n&&s.isVector3&&n.isVector3||s&&n&&s.isMatrix3&&n.isMatrix3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";if(!t&&e.textures[this.uuid]!==void 0)return e.textures[this.uuid];let n={metadata:{version:4.7,type:"Texture",generator:"Texture.toJSON"},uuid:this.uuid,name:this.name,image:this.source.toJSON(e).uuid,mapping:this.mapping,channel:this.channel,repeat:[this.repeat.x,this.repeat.y],offset:[this.offset.x,this.offset.y],center:[this.center.x,this.center.y],rotation:this.rotation,wrap:[this.wrapS,this.wrapT],format:this.format,internalFormat:this.internalFormat,type:this.type,normalized:this.normalized,colorSpace:this.colorSpace,minFilter:this.minFilter,magFilter:this.magFilter,anisotropy:this.anisotropy,flipY:this.flipY,generateMipmaps:this.generateMipmaps,mipmapsAutoUpdate:this.mipmapsAutoUpdate,premultiplyAlpha:this.premultiplyAlpha,unpackAlignment:this.unpackAlignment};return Object.keys(this.userData).length>0&&(n.userData=this.userData),t||(e.textures[this.uuid]=n),n}dispose(){this.dispatchEvent({type:"dispose"})}transformUv(e){if(this.mapping!==xd)return e;if(e.applyMatrix3(this.matrix),e.x<0||e.x>1)switch(this.wrapS){case Zl:e.x=e.x-Math.floor(e.x);break;case qi:e.x=e.x<0?0:1;break;case Jl:Math.abs(Math.floor(e.x)%2)===1?e.x=Math.ceil(e.x)-e.x:e.x=e.x-Math.floor(e.x);break}if(e.y<0||e.y>1)switch(this.wrapT){case Zl:e.y=e.y-Math.floor(e.y);break;case qi:e.y=e.y<0?0:1;break;case Jl:Math.abs(Math.floor(e.y)%2)===1?e.y=Math.ceil(e.y)-e.y:e.y=e.y-Math.floor(e.y);break}return this.flipY&&(e.y=1-e.y),e}set needsUpdate(e){e===!0&&(this.version++,this.source.needsUpdate=!0)}set needsPMREMUpdate(e){e===!0&&this.pmremVersion++}};Jn.DEFAULT_IMAGE=null;Jn.DEFAULT_MAPPING=xd;Jn.DEFAULT_ANISOTROPY=1;var Hd=class Hd{constructor(e=0,t=0,n=0,s=1){this.x=e,this.y=t,this.z=n,this.w=s}get width(){return this.z}set width(e){this.z=e}get height(){return this.w}set height(e){this.w=e}set(e,t,n,s){return this.x=e,this.y=t,this.z=n,this.w=s,this}setScalar(e){return this.x=e,this.y=e,this.z=e,this.w=e,this}setX(e){return this.x=e,this}setY(e){return this.y=e,this}setZ(e){return this.z=e,this}setW(e){return this.w=e,this}setComponent(e,t){switch(e){case 0:this.x=t;break;case 1:this.y=t;break;case 2:this.z=t;break;case 3:this.w=t;break;default:throw new Error("THREE.Vector4: index is out of range: "+e)}return this}getComponent(e){switch(e){case 0:return this.x;case 1:return this.y;case 2:return this.z;case 3:return this.w;default:throw new Error("THREE.Vector4: index is out of range: "+e)}}clone(){return new this.constructor(this.x,this.y,this.z,this.w)}copy(e){return this.x=e.x,this.y=e.y,this.z=e.z,this.w=e.w!==void 0?e.w:1,this}add(e){return this.x+=e.x,this.y+=e.y,this.z+=e.z,this.w+=e.w,this}addScalar(e){return this.x+=e,this.y+=e,this.z+=e,this.w+=e,this}addVectors(e,t){return this.x=e.x+t.x,this.y=e.y+t.y,this.z=e.z+t.z,this.w=e.w+t.w,this}addScaledVector(e,t){return this.x+=e.x*t,this.y+=e.y*t,this.z+=e.z*t,this.w+=e.w*t,this}sub(e){return this.x-=e.x,this.y-=e.y,this.z-=e.z,this.w-=e.w,this}subScalar(e){return this.x-=e,this.y-=e,this.z-=e,this.w-=e,this}subVectors(e,t){return this.x=e.x-t.x,this.y=e.y-t.y,this.z=e.z-t.z,this.w=e.w-t.w,this}multiply(e){return this.x*=e.x,this.y*=e.y,this.z*=e.z,this.w*=e.w,this}multiplyScalar(e){return this.x*=e,this.y*=e,this.z*=e,this.w*=e,this}applyMatrix4(e){let t=this.x,n=this.y,s=this.z,r=this.w,o=e.elements;return this.x=o[0]*t+o[4]*n+o[8]*s+o[12]*r,this.y=o[1]*t+o[5]*n+o[9]*s+o[13]*r,this.z=o[2]*t+o[6]*n+o[10]*s+o[14]*r,this.w=o[3]*t+o[7]*n+o[11]*s+o[15]*r,this}divide(e){return this.x/=e.x,this.y/=e.y,this.z/=e.z,this.w/=e.w,this}divideScalar(e){return this.multiplyScalar(1/e)}setAxisAngleFromQuaternion(e){this.w=2*Math.acos(e.w);let t=Math.sqrt(1-e.w*e.w);return t<1e-4?(this.x=1,this.y=0,this.z=0):(this.x=e.x/t,this.y=e.y/t,this.z=e.z/t),this}setAxisAngleFromRotationMatrix(e){let t,n,s,r,l=e.elements,c=l[0],h=l[4],d=l[8],u=l[1],f=l[5],p=l[9],x=l[2],m=l[6],g=l[10];if(Math.abs(h-u)<.01&&Math.abs(d-x)<.01&&Math.abs(p-m)<.01){if(Math.abs(h+u)<.1&&Math.abs(d+x)<.1&&Math.abs(p+m)<.1&&Math.abs(c+f+g-3)<.1)return this.set(1,0,0,0),this;t=Math.PI;let T=(c+1)/2,y=(f+1)/2,C=(g+1)/2,A=(h+u)/4,v=(d+x)/4,E=(p+m)/4;return T>y&&T>C?T<.01?(n=0,s=.707106781,r=.707106781):(n=Math.sqrt(T),s=A/n,r=v/n):y>C?y<.01?(n=.707106781,s=0,r=.707106781):(s=Math.sqrt(y),n=A/s,r=E/s):C<.01?(n=.707106781,s=.707106781,r=0):(r=Math.sqrt(C),n=v/r,s=E/r),this.set(n,s,r,t),this}let S=Math.sqrt((m-p)*(m-p)+(d-x)*(d-x)+(u-h)*(u-h));return Math.abs(S)<.001&&(S=1),this.x=(m-p)/S,this.y=(d-x)/S,this.z=(u-h)/S,this.w=Math.acos((c+f+g-1)/2),this}setFromMatrixPosition(e){let t=e.elements;return this.x=t[12],this.y=t[13],this.z=t[14],this.w=t[15],this}min(e){return this.x=Math.min(this.x,e.x),this.y=Math.min(this.y,e.y),this.z=Math.min(this.z,e.z),this.w=Math.min(this.w,e.w),this}max(e){return this.x=Math.max(this.x,e.x),this.y=Math.max(this.y,e.y),this.z=Math.max(this.z,e.z),this.w=Math.max(this.w,e.w),this}clamp(e,t){return this.x=wt(this.x,e.x,t.x),this.y=wt(this.y,e.y,t.y),this.z=wt(this.z,e.z,t.z),this.w=wt(this.w,e.w,t.w),this}clampScalar(e,t){return this.x=wt(this.x,e,t),this.y=wt(this.y,e,t),this.z=wt(this.z,e,t),this.w=wt(this.w,e,t),this}clampLength(e,t){let n=this.length();return this.divideScalar(n||1).multiplyScalar(wt(n,e,t))}floor(){return this.x=Math.floor(this.x),this.y=Math.floor(this.y),this.z=Math.floor(this.z),this.w=Math.floor(this.w),this}ceil(){return this.x=Math.ceil(this.x),this.y=Math.ceil(this.y),this.z=Math.ceil(this.z),this.w=Math.ceil(this.w),this}round(){return this.x=Math.round(this.x),this.y=Math.round(this.y),this.z=Math.round(this.z),this.w=Math.round(this.w),this}roundToZero(){return this.x=Math.trunc(this.x),this.y=Math.trunc(this.y),this.z=Math.trunc(this.z),this.w=Math.trunc(this.w),this}negate(){return this.x=-this.x,this.y=-this.y,this.z=-this.z,this.w=-this.w,this}dot(e){return this.x*e.x+this.y*e.y+this.z*e.z+this.w*e.w}lengthSq(){return this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w}length(){return Math.sqrt(this.x*this.x+this.y*this.y+this.z*this.z+this.w*this.w)}manhattanLength(){return Math.abs(this.x)+Math.abs(this.y)+Math.abs(this.z)+Math.abs(this.w)}normalize(){return this.divideScalar(this.length()||1)}setLength(e){return this.normalize().multiplyScalar(e)}lerp(e,t){return this.x+=(e.x-this.x)*t,this.y+=(e.y-this.y)*t,this.z+=(e.z-this.z)*t,this.w+=(e.w-this.w)*t,this}lerpVectors(e,t,n){return this.x=e.x+(t.x-e.x)*n,this.y=e.y+(t.y-e.y)*n,this.z=e.z+(t.z-e.z)*n,this.w=e.w+(t.w-e.w)*n,this}equals(e){return e.x===this.x&&e.y===this.y&&e.z===this.z&&e.w===this.w}fromArray(e,t=0){return this.x=e[t],this.y=e[t+1],this.z=e[t+2],this.w=e[t+3],this}toArray(e=[],t=0){return e[t]=this.x,e[t+1]=this.y,e[t+2]=this.z,e[t+3]=this.w,e}fromBufferAttribute(e,t){return this.x=e.getX(t),this.y=e.getY(t),this.z=e.getZ(t),this.w=e.getW(t),this}random(){return this.x=Math.random(),this.y=Math.random(),this.z=Math.random(),this.w=Math.random(),this}*[Symbol.iterator](){yield this.x,yield this.y,yield this.z,yield this.w}};Hd.prototype.isVector4=!0;var tn=Hd,ec=class extends $i{constructor(e=1,t=1,n={}){super(),n=Object.assign({generateMipmaps:!1,internalFormat:null,minFilter:Zn,depthBuffer:!0,stencilBuffer:!1,resolveColorBuffer:!0,resolveDepthBuffer:!0,resolveStencilBuffer:!0,storeMultisampledColorBuffer:!0,storeMultisampledDepthBuffer:!0,storeMultisampledStencilBuffer:!0,depthTexture:null,samples:0,count:1,depth:1,multiview:!1,useArrayDepthTexture:!1},n),this.isRenderTarget=!0,this.width=e,this.height=t,this.depth=n.depth,this.scissor=new tn(0,0,e,t),this.scissorTest=!1,this.viewport=new tn(0,0,e,t),this.textures=[];let s=n.count;for(let r=0;r<s;r++)this.textures[r]=new Jn({width:e,height:t,depth:n.depth}),this.textures[r].isRenderTargetTexture=!0,this.textures[r].renderTarget=this;this._setTextureOptions(n),this.depthBuffer=n.depthBuffer,this.stencilBuffer=n.stencilBuffer,this.resolveColorBuffer=n.resolveColorBuffer,this.resolveDepthBuffer=n.resolveDepthBuffer,this.resolveStencilBuffer=n.resolveStencilBuffer,this.storeMultisampledColorBuffer=n.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=n.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=n.storeMultisampledStencilBuffer,this._depthTexture=null,this.depthTexture=n.depthTexture,this.samples=n.samples,this.multiview=n.multiview,this.useArrayDepthTexture=n.useArrayDepthTexture}_setTextureOptions(e={}){let t={minFilter:Zn,generateMipmaps:!1,flipY:!1,internalFormat:null};e.mapping!==void 0&&(t.mapping=e.mapping),e.wrapS!==void 0&&(t.wrapS=e.wrapS),e.wrapT!==void 0&&(t.wrapT=e.wrapT),e.wrapR!==void 0&&(t.wrapR=e.wrapR),e.magFilter!==void 0&&(t.magFilter=e.magFilter),e.minFilter!==void 0&&(t.minFilter=e.minFilter),e.format!==void 0&&(t.format=e.format),e.type!==void 0&&(t.type=e.type),e.anisotropy!==void 0&&(t.anisotropy=e.anisotropy),e.colorSpace!==void 0&&(t.colorSpace=e.colorSpace),e.flipY!==void 0&&(t.flipY=e.flipY),e.generateMipmaps!==void 0&&(t.generateMipmaps=e.generateMipmaps),e.mipmapsAutoUpdate!==void 0&&(t.mipmapsAutoUpdate=e.mipmapsAutoUpdate),e.internalFormat!==void 0&&(t.internalFormat=e.internalFormat);for(let n=0;n<this.textures.length;n++)this.textures[n].setValues(t)}get texture(){return this.textures[0]}set texture(e){this.textures[0]=e}set depthTexture(e){this._depthTexture!==null&&this._depthTexture.renderTarget===this&&(this._depthTexture.renderTarget=null),e!==null&&e.renderTarget===null&&(e.renderTarget=this),this._depthTexture=e}get depthTexture(){return this._depthTexture}setSize(e,t,n=1){if(this.width!==e||this.height!==t||this.depth!==n){this.width=e,this.height=t,this.depth=n;for(let s=0,r=this.textures.length;s<r;s++)this.textures[s].image.width=e,this.textures[s].image.height=t,this.textures[s].image.depth=n,this.textures[s].isData3DTexture!==!0&&(this.textures[s].isArrayTexture=this.textures[s].image.depth>1);this.dispose()}this.viewport.set(0,0,e,t),this.scissor.set(0,0,e,t)}clone(){return new this.constructor().copy(this)}copy(e){this.width=e.width,this.height=e.height,this.depth=e.depth,this.scissor.copy(e.scissor),this.scissorTest=e.scissorTest,this.viewport.copy(e.viewport),this.textures.length=0;for(let t=0,n=e.textures.length;t<n;t++){this.textures[t]=e.textures[t].clone(),this.textures[t].isRenderTargetTexture=!0,this.textures[t].renderTarget=this;let s=Object.assign({},e.textures[t].image);this.textures[t].source=new io(s)}if(this.depthBuffer=e.depthBuffer,this.stencilBuffer=e.stencilBuffer,this.resolveColorBuffer=e.resolveColorBuffer,this.resolveDepthBuffer=e.resolveDepthBuffer,this.resolveStencilBuffer=e.resolveStencilBuffer,this.storeMultisampledColorBuffer=e.storeMultisampledColorBuffer,this.storeMultisampledDepthBuffer=e.storeMultisampledDepthBuffer,this.storeMultisampledStencilBuffer=e.storeMultisampledStencilBuffer,e.depthTexture!==null)if(e.depthTexture.renderTarget===e){let t=e.depthTexture.clone();t.renderTarget=null,this.depthTexture=t}else this.depthTexture=e.depthTexture;else this.depthTexture=null;return this.samples=e.samples,this.multiview=e.multiview,this.useArrayDepthTexture=e.useArrayDepthTexture,this}dispose(){this.dispatchEvent({type:"dispose"})}},oi=class extends ec{constructor(e=1,t=1,n={}){super(e,t,n),this.isWebGLRenderTarget=!0}},aa=class extends Jn{constructor(e=null,t=1,n=1,s=1){super(null),this.isDataArrayTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Pn,this.minFilter=Pn,this.wrapR=qi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1,this.layerUpdates=new Set}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}addLayerUpdate(e){this.layerUpdates.add(e)}clearLayerUpdates(){this.layerUpdates.clear()}};var tc=class extends Jn{constructor(e=null,t=1,n=1,s=1){super(null),this.isData3DTexture=!0,this.image={data:e,width:t,height:n,depth:s},this.magFilter=Pn,this.minFilter=Pn,this.wrapR=qi,this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}copy(e){return super.copy(e),this.wrapR=e.wrapR,this}};var Ac=class Ac{constructor(e,t,n,s,r,o,a,l,c,h,d,u,f,p,x,m){this.elements=[1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1],e!==void 0&&this.set(e,t,n,s,r,o,a,l,c,h,d,u,f,p,x,m)}set(e,t,n,s,r,o,a,l,c,h,d,u,f,p,x,m){let g=this.elements;return g[0]=e,g[4]=t,g[8]=n,g[12]=s,g[1]=r,g[5]=o,g[9]=a,g[13]=l,g[2]=c,g[6]=h,g[10]=d,g[14]=u,g[3]=f,g[7]=p,g[11]=x,g[15]=m,this}identity(){return this.set(1,0,0,0,0,1,0,0,0,0,1,0,0,0,0,1),this}clone(){return new Ac().fromArray(this.elements)}copy(e){let t=this.elements,n=e.elements;return t[0]=n[0],t[1]=n[1],t[2]=n[2],t[3]=n[3],t[4]=n[4],t[5]=n[5],t[6]=n[6],t[7]=n[7],t[8]=n[8],t[9]=n[9],t[10]=n[10],t[11]=n[11],t[12]=n[12],t[13]=n[13],t[14]=n[14],t[15]=n[15],this}copyPosition(e){let t=this.elements,n=e.elements;return t[12]=n[12],t[13]=n[13],t[14]=n[14],this}setFromMatrix3(e){let t=e.elements;return this.set(t[0],t[3],t[6],0,t[1],t[4],t[7],0,t[2],t[5],t[8],0,0,0,0,1),this}extractBasis(e,t,n){return this.determinantAffine()===0?(e.set(1,0,0),t.set(0,1,0),n.set(0,0,1),this):(e.setFromMatrixColumn(this,0),t.setFromMatrixColumn(this,1),n.setFromMatrixColumn(this,2),this)}makeBasis(e,t,n){return this.set(e.x,t.x,n.x,0,e.y,t.y,n.y,0,e.z,t.z,n.z,0,0,0,0,1),this}extractRotation(e){if(e.determinantAffine()===0)return this.identity();let t=this.elements,n=e.elements,s=1/Or.setFromMatrixColumn(e,0).length(),r=1/Or.setFromMatrixColumn(e,1).length(),o=1/Or.setFromMatrixColumn(e,2).length();return t[0]=n[0]*s,t[1]=n[1]*s,t[2]=n[2]*s,t[3]=0,t[4]=n[4]*r,t[5]=n[5]*r,t[6]=n[6]*r,t[7]=0,t[8]=n[8]*o,t[9]=n[9]*o,t[10]=n[10]*o,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromEuler(e){let t=this.elements,n=e.x,s=e.y,r=e.z,o=Math.cos(n),a=Math.sin(n),l=Math.cos(s),c=Math.sin(s),h=Math.cos(r),d=Math.sin(r);if(e.order==="XYZ"){let u=o*h,f=o*d,p=a*h,x=a*d;t[0]=l*h,t[4]=-l*d,t[8]=c,t[1]=f+p*c,t[5]=u-x*c,t[9]=-a*l,t[2]=x-u*c,t[6]=p+f*c,t[10]=o*l}else if(e.order==="YXZ"){let u=l*h,f=l*d,p=c*h,x=c*d;t[0]=u+x*a,t[4]=p*a-f,t[8]=o*c,t[1]=o*d,t[5]=o*h,t[9]=-a,t[2]=f*a-p,t[6]=x+u*a,t[10]=o*l}else if(e.order==="ZXY"){let u=l*h,f=l*d,p=c*h,x=c*d;t[0]=u-x*a,t[4]=-o*d,t[8]=p+f*a,t[1]=f+p*a,t[5]=o*h,t[9]=x-u*a,t[2]=-o*c,t[6]=a,t[10]=o*l}else if(e.order==="ZYX"){let u=o*h,f=o*d,p=a*h,x=a*d;t[0]=l*h,t[4]=p*c-f,t[8]=u*c+x,t[1]=l*d,t[5]=x*c+u,t[9]=f*c-p,t[2]=-c,t[6]=a*l,t[10]=o*l}else if(e.order==="YZX"){let u=o*l,f=o*c,p=a*l,x=a*c;t[0]=l*h,t[4]=x-u*d,t[8]=p*d+f,t[1]=d,t[5]=o*h,t[9]=-a*h,t[2]=-c*h,t[6]=f*d+p,t[10]=u-x*d}else if(e.order==="XZY"){let u=o*l,f=o*c,p=a*l,x=a*c;t[0]=l*h,t[4]=-d,t[8]=c*h,t[1]=u*d+x,t[5]=o*h,t[9]=f*d-p,t[2]=p*d-f,t[6]=a*h,t[10]=x*d+u}return t[3]=0,t[7]=0,t[11]=0,t[12]=0,t[13]=0,t[14]=0,t[15]=1,this}makeRotationFromQuaternion(e){return this.compose($_,e,Z_)}lookAt(e,t,n){let s=this.elements;return si.subVectors(e,t),si.lengthSq()===0&&(si.z=1),si.normalize(),Ps.crossVectors(n,si),Ps.lengthSq()===0&&(Math.abs(n.z)===1?si.x+=1e-4:si.z+=1e-4,si.normalize(),Ps.crossVectors(n,si)),Ps.normalize(),cl.crossVectors(si,Ps),s[0]=Ps.x,s[4]=cl.x,s[8]=si.x,s[1]=Ps.y,s[5]=cl.y,s[9]=si.y,s[2]=Ps.z,s[6]=cl.z,s[10]=si.z,this}multiply(e){return this.multiplyMatrices(this,e)}premultiply(e){return this.multiplyMatrices(e,this)}multiplyMatrices(e,t){let n=e.elements,s=t.elements,r=this.elements,o=n[0],a=n[4],l=n[8],c=n[12],h=n[1],d=n[5],u=n[9],f=n[13],p=n[2],x=n[6],m=n[10],g=n[14],S=n[3],T=n[7],y=n[11],C=n[15],A=s[0],v=s[4],E=s[8],k=s[12],N=s[1],I=s[5],G=s[9],W=s[13],L=s[2],H=s[6],Y=s[10],z=s[14],ce=s[3],J=s[7],j=s[11],te=s[15];return r[0]=o*A+a*N+l*L+c*ce,r[4]=o*v+a*I+l*H+c*J,r[8]=o*E+a*G+l*Y+c*j,r[12]=o*k+a*W+l*z+c*te,r[1]=h*A+d*N+u*L+f*ce,r[5]=h*v+d*I+u*H+f*J,r[9]=h*E+d*G+u*Y+f*j,r[13]=h*k+d*W+u*z+f*te,r[2]=p*A+x*N+m*L+g*ce,r[6]=p*v+x*I+m*H+g*J,r[10]=p*E+x*G+m*Y+g*j,r[14]=p*k+x*W+m*z+g*te,r[3]=S*A+T*N+y*L+C*ce,r[7]=S*v+T*I+y*H+C*J,r[11]=S*E+T*G+y*Y+C*j,r[15]=S*k+T*W+y*z+C*te,this}multiplyScalar(e){let t=this.elements;return t[0]*=e,t[4]*=e,t[8]*=e,t[12]*=e,t[1]*=e,t[5]*=e,t[9]*=e,t[13]*=e,t[2]*=e,t[6]*=e,t[10]*=e,t[14]*=e,t[3]*=e,t[7]*=e,t[11]*=e,t[15]*=e,this}determinant(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[12],o=e[1],a=e[5],l=e[9],c=e[13],h=e[2],d=e[6],u=e[10],f=e[14],p=e[3],x=e[7],m=e[11],g=e[15],S=l*f-c*u,T=a*f-c*d,y=a*u-l*d,C=o*f-c*h,A=o*u-l*h,v=o*d-a*h;return t*(x*S-m*T+g*y)-n*(p*S-m*C+g*A)+s*(p*T-x*C+g*v)-r*(p*y-x*A+m*v)}determinantAffine(){let e=this.elements,t=e[0],n=e[4],s=e[8],r=e[1],o=e[5],a=e[9],l=e[2],c=e[6],h=e[10];return t*(o*h-a*c)-n*(r*h-a*l)+s*(r*c-o*l)}transpose(){let e=this.elements,t;return t=e[1],e[1]=e[4],e[4]=t,t=e[2],e[2]=e[8],e[8]=t,t=e[6],e[6]=e[9],e[9]=t,t=e[3],e[3]=e[12],e[12]=t,t=e[7],e[7]=e[13],e[13]=t,t=e[11],e[11]=e[14],e[14]=t,this}setPosition(e,t,n){let s=this.elements;return e.isVector3?(s[12]=e.x,s[13]=e.y,s[14]=e.z):(s[12]=e,s[13]=t,s[14]=n),this}invert(){let e=this.elements,t=e[0],n=e[1],s=e[2],r=e[3],o=e[4],a=e[5],l=e[6],c=e[7],h=e[8],d=e[9],u=e[10],f=e[11],p=e[12],x=e[13],m=e[14],g=e[15],S=t*a-n*o,T=t*l-s*o,y=t*c-r*o,C=n*l-s*a,A=n*c-r*a,v=s*c-r*l,E=h*x-d*p,k=h*m-u*p,N=h*g-f*p,I=d*m-u*x,G=d*g-f*x,W=u*g-f*m,L=S*W-T*G+y*I+C*N-A*k+v*E;if(L===0)return this.set(0,0,0,0,0,0,0,0,0,0,0,0,0,0,0,0);let H=1/L;return e[0]=(a*W-l*G+c*I)*H,e[1]=(s*G-n*W-r*I)*H,e[2]=(x*v-m*A+g*C)*H,e[3]=(u*A-d*v-f*C)*H,e[4]=(l*N-o*W-c*k)*H,e[5]=(t*W-s*N+r*k)*H,e[6]=(m*y-p*v-g*T)*H,e[7]=(h*v-u*y+f*T)*H,e[8]=(o*G-a*N+c*E)*H,e[9]=(n*N-t*G-r*E)*H,e[10]=(p*A-x*y+g*S)*H,e[11]=(d*y-h*A-f*S)*H,e[12]=(a*k-o*I-l*E)*H,e[13]=(t*I-n*k+s*E)*H,e[14]=(x*T-p*C-m*S)*H,e[15]=(h*C-d*T+u*S)*H,this}scale(e){let t=this.elements,n=e.x,s=e.y,r=e.z;return t[0]*=n,t[4]*=s,t[8]*=r,t[1]*=n,t[5]*=s,t[9]*=r,t[2]*=n,t[6]*=s,t[10]*=r,t[3]*=n,t[7]*=s,t[11]*=r,this}getMaxScaleOnAxis(){let e=this.elements,t=e[0]*e[0]+e[1]*e[1]+e[2]*e[2],n=e[4]*e[4]+e[5]*e[5]+e[6]*e[6],s=e[8]*e[8]+e[9]*e[9]+e[10]*e[10];return Math.sqrt(Math.max(t,n,s))}makeTranslation(e,t,n){return e.isVector3?this.set(1,0,0,e.x,0,1,0,e.y,0,0,1,e.z,0,0,0,1):this.set(1,0,0,e,0,1,0,t,0,0,1,n,0,0,0,1),this}makeRotationX(e){let t=Math.cos(e),n=Math.sin(e);return this.set(1,0,0,0,0,t,-n,0,0,n,t,0,0,0,0,1),this}makeRotationY(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,0,n,0,0,1,0,0,-n,0,t,0,0,0,0,1),this}makeRotationZ(e){let t=Math.cos(e),n=Math.sin(e);return this.set(t,-n,0,0,n,t,0,0,0,0,1,0,0,0,0,1),this}makeRotationAxis(e,t){let n=Math.cos(t),s=Math.sin(t),r=1-n,o=e.x,a=e.y,l=e.z,c=r*o,h=r*a;return this.set(c*o+n,c*a-s*l,c*l+s*a,0,c*a+s*l,h*a+n,h*l-s*o,0,c*l-s*a,h*l+s*o,r*l*l+n,0,0,0,0,1),this}makeScale(e,t,n){return this.set(e,0,0,0,0,t,0,0,0,0,n,0,0,0,0,1),this}makeShear(e,t,n,s,r,o){return this.set(1,n,r,0,e,1,o,0,t,s,1,0,0,0,0,1),this}compose(e,t,n){let s=this.elements,r=t._x,o=t._y,a=t._z,l=t._w,c=r+r,h=o+o,d=a+a,u=r*c,f=r*h,p=r*d,x=o*h,m=o*d,g=a*d,S=l*c,T=l*h,y=l*d,C=n.x,A=n.y,v=n.z;return s[0]=(1-(x+g))*C,s[1]=(f+y)*C,s[2]=(p-T)*C,s[3]=0,s[4]=(f-y)*A,s[5]=(1-(u+g))*A,s[6]=(m+S)*A,s[7]=0,s[8]=(p+T)*v,s[9]=(m-S)*v,s[10]=(1-(u+x))*v,s[11]=0,s[12]=e.x,s[13]=e.y,s[14]=e.z,s[15]=1,this}decompose(e,t,n){let s=this.elements;e.x=s[12],e.y=s[13],e.z=s[14];let r=this.determinantAffine();if(r===0)return n.set(1,1,1),t.identity(),this;let o=Or.set(s[0],s[1],s[2]).length(),a=Or.set(s[4],s[5],s[6]).length(),l=Or.set(s[8],s[9],s[10]).length();r<0&&(o=-o),bi.copy(this);let c=1/o,h=1/a,d=1/l;return bi.elements[0]*=c,bi.elements[1]*=c,bi.elements[2]*=c,bi.elements[4]*=h,bi.elements[5]*=h,bi.elements[6]*=h,bi.elements[8]*=d,bi.elements[9]*=d,bi.elements[10]*=d,t.setFromRotationMatrix(bi),n.x=o,n.y=a,n.z=l,this}makePerspective(e,t,n,s,r,o,a=gi,l=!1){let c=this.elements,h=2*r/(t-e),d=2*r/(n-s),u=(t+e)/(t-e),f=(n+s)/(n-s),p,x;if(l)p=r/(o-r),x=o*r/(o-r);else if(a===gi)p=-(o+r)/(o-r),x=-2*o*r/(o-r);else if(a===to)p=-o/(o-r),x=-o*r/(o-r);else throw new Error("THREE.Matrix4.makePerspective(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=u,c[12]=0,c[1]=0,c[5]=d,c[9]=f,c[13]=0,c[2]=0,c[6]=0,c[10]=p,c[14]=x,c[3]=0,c[7]=0,c[11]=-1,c[15]=0,this}makeOrthographic(e,t,n,s,r,o,a=gi,l=!1){let c=this.elements,h=2/(t-e),d=2/(n-s),u=-(t+e)/(t-e),f=-(n+s)/(n-s),p,x;if(l)p=1/(o-r),x=o/(o-r);else if(a===gi)p=-2/(o-r),x=-(o+r)/(o-r);else if(a===to)p=-1/(o-r),x=-r/(o-r);else throw new Error("THREE.Matrix4.makeOrthographic(): Invalid coordinate system: "+a);return c[0]=h,c[4]=0,c[8]=0,c[12]=u,c[1]=0,c[5]=d,c[9]=0,c[13]=f,c[2]=0,c[6]=0,c[10]=p,c[14]=x,c[3]=0,c[7]=0,c[11]=0,c[15]=1,this}equals(e){let t=this.elements,n=e.elements;for(let s=0;s<16;s++)if(t[s]!==n[s])return!1;return!0}fromArray(e,t=0){for(let n=0;n<16;n++)this.elements[n]=e[n+t];return this}toArray(e=[],t=0){let n=this.elements;return e[t]=n[0],e[t+1]=n[1],e[t+2]=n[2],e[t+3]=n[3],e[t+4]=n[4],e[t+5]=n[5],e[t+6]=n[6],e[t+7]=n[7],e[t+8]=n[8],e[t+9]=n[9],e[t+10]=n[10],e[t+11]=n[11],e[t+12]=n[12],e[t+13]=n[13],e[t+14]=n[14],e[t+15]=n[15],e}};Ac.prototype.isMatrix4=!0;var Ft=Ac,Or=new X,bi=new Ft,$_=new X(0,0,0),Z_=new X(1,1,1),Ps=new X,cl=new X,si=new X,Ep=new Ft,Tp=new _i,ps=class i{constructor(e=0,t=0,n=0,s=i.DEFAULT_ORDER){this.isEuler=!0,this._x=e,this._y=t,this._z=n,this._order=s}get x(){return this._x}set x(e){this._x=e,this._onChangeCallback()}get y(){return this._y}set y(e){this._y=e,this._onChangeCallback()}get z(){return this._z}set z(e){this._z=e,this._onChangeCallback()}get order(){return this._order}set order(e){this._order=e,this._onChangeCallback()}set(e,t,n,s=this._order){return this._x=e,this._y=t,this._z=n,this._order=s,this._onChangeCallback(),this}clone(){return new this.constructor(this._x,this._y,this._z,this._order)}copy(e){return this._x=e._x,this._y=e._y,this._z=e._z,this._order=e._order,this._onChangeCallback(),this}setFromRotationMatrix(e,t=this._order,n=!0){let s=e.elements,r=s[0],o=s[4],a=s[8],l=s[1],c=s[5],h=s[9],d=s[2],u=s[6],f=s[10];switch(t){case"XYZ":this._y=Math.asin(wt(a,-1,1)),Math.abs(a)<.9999999?(this._x=Math.atan2(-h,f),this._z=Math.atan2(-o,r)):(this._x=Math.atan2(u,c),this._z=0);break;case"YXZ":this._x=Math.asin(-wt(h,-1,1)),Math.abs(h)<.9999999?(this._y=Math.atan2(a,f),this._z=Math.atan2(l,c)):(this._y=Math.atan2(-d,r),this._z=0);break;case"ZXY":this._x=Math.asin(wt(u,-1,1)),Math.abs(u)<.9999999?(this._y=Math.atan2(-d,f),this._z=Math.atan2(-o,c)):(this._y=0,this._z=Math.atan2(l,r));break;case"ZYX":this._y=Math.asin(-wt(d,-1,1)),Math.abs(d)<.9999999?(this._x=Math.atan2(u,f),this._z=Math.atan2(l,r)):(this._x=0,this._z=Math.atan2(-o,c));break;case"YZX":this._z=Math.asin(wt(l,-1,1)),Math.abs(l)<.9999999?(this._x=Math.atan2(-h,c),this._y=Math.atan2(-d,r)):(this._x=0,this._y=Math.atan2(a,f));break;case"XZY":this._z=Math.asin(-wt(o,-1,1)),Math.abs(o)<.9999999?(this._x=Math.atan2(u,c),this._y=Math.atan2(a,r)):(this._x=Math.atan2(-h,f),this._y=0);break;default:tt("Euler: .setFromRotationMatrix() encountered an unknown order: "+t)}return this._order=t,n===!0&&this._onChangeCallback(),this}setFromQuaternion(e,t,n){return Ep.makeRotationFromQuaternion(e),this.setFromRotationMatrix(Ep,t,n)}setFromVector3(e,t=this._order){return this.set(e.x,e.y,e.z,t)}reorder(e){return Tp.setFromEuler(this),this.setFromQuaternion(Tp,e)}equals(e){return e._x===this._x&&e._y===this._y&&e._z===this._z&&e._order===this._order}fromArray(e){return this._x=e[0],this._y=e[1],this._z=e[2],e[3]!==void 0&&(this._order=e[3]),this._onChangeCallback(),this}toArray(e=[],t=0){return e[t]=this._x,e[t+1]=this._y,e[t+2]=this._z,e[t+3]=this._order,e}_onChange(e){return this._onChangeCallback=e,this}_onChangeCallback(){}*[Symbol.iterator](){yield this._x,yield this._y,yield this._z,yield this._order}};ps.DEFAULT_ORDER="XYZ";var la=class{constructor(){this.mask=1}set(e){this.mask=(1<<e|0)>>>0}enable(e){this.mask|=1<<e|0}enableAll(){this.mask=-1}toggle(e){this.mask^=1<<e|0}disable(e){this.mask&=~(1<<e|0)}disableAll(){this.mask=0}test(e){return(this.mask&e.mask)!==0}isEnabled(e){return(this.mask&(1<<e|0))!==0}},J_=0,Ap=new X,Br=new _i,as=new Ft,hl=new X,Wo=new X,K_=new X,Q_=new _i,Rp=new X(1,0,0),Cp=new X(0,1,0),Pp=new X(0,0,1),Ip={type:"added"},j_={type:"removed"},kr={type:"childadded",child:null},Au={type:"childremoved",child:null},In=class i extends $i{constructor(){super(),this.isObject3D=!0,Object.defineProperty(this,"id",{value:J_++}),this.uuid=Vs(),this.name="",this.type="Object3D",this.parent=null,this.children=[],this.up=i.DEFAULT_UP.clone();let e=new X,t=new ps,n=new _i,s=new X(1,1,1);function r(){n.setFromEuler(t,!1)}function o(){t.setFromQuaternion(n,void 0,!1)}t._onChange(r),n._onChange(o),Object.defineProperties(this,{position:{configurable:!0,enumerable:!0,value:e},rotation:{configurable:!0,enumerable:!0,value:t},quaternion:{configurable:!0,enumerable:!0,value:n},scale:{configurable:!0,enumerable:!0,value:s},modelViewMatrix:{value:new Ft},normalMatrix:{value:new ft}}),this.matrix=new Ft,this.matrixWorld=new Ft,this.matrixAutoUpdate=i.DEFAULT_MATRIX_AUTO_UPDATE,this.matrixWorldAutoUpdate=i.DEFAULT_MATRIX_WORLD_AUTO_UPDATE,this.matrixWorldNeedsUpdate=!1,this.layers=new la,this.visible=!0,this.castShadow=!1,this.receiveShadow=!1,this.frustumCulled=!0,this.renderOrder=0,this.animations=[],this.customDepthMaterial=void 0,this.customDistanceMaterial=void 0,this.static=!1,this.userData={},this.pivot=null}onBeforeShadow(){}onAfterShadow(){}onBeforeRender(){}onAfterRender(){}applyMatrix4(e){this.matrixAutoUpdate&&this.updateMatrix(),this.matrix.premultiply(e),this.matrix.decompose(this.position,this.quaternion,this.scale),this.pivot!==null&&this.position.copy(this.pivot).applyMatrix4(this.matrix).sub(this.pivot)}applyQuaternion(e){return this.quaternion.premultiply(e),this}setRotationFromAxisAngle(e,t){this.quaternion.setFromAxisAngle(e,t)}setRotationFromEuler(e){this.quaternion.setFromEuler(e,!0)}setRotationFromMatrix(e){this.quaternion.setFromRotationMatrix(e)}setRotationFromQuaternion(e){this.quaternion.copy(e)}rotateOnAxis(e,t){return Br.setFromAxisAngle(e,t),this.quaternion.multiply(Br),this}rotateOnWorldAxis(e,t){return Br.setFromAxisAngle(e,t),this.quaternion.premultiply(Br),this}rotateX(e){return this.rotateOnAxis(Rp,e)}rotateY(e){return this.rotateOnAxis(Cp,e)}rotateZ(e){return this.rotateOnAxis(Pp,e)}translateOnAxis(e,t){return Ap.copy(e).applyQuaternion(this.quaternion),this.position.add(Ap.multiplyScalar(t)),this}translateX(e){return this.translateOnAxis(Rp,e)}translateY(e){return this.translateOnAxis(Cp,e)}translateZ(e){return this.translateOnAxis(Pp,e)}localToWorld(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(this.matrixWorld)}worldToLocal(e){return this.updateWorldMatrix(!0,!1),e.applyMatrix4(as.copy(this.matrixWorld).invert())}lookAt(e,t,n){e.isVector3?hl.copy(e):hl.set(e,t,n);let s=this.parent;this.updateWorldMatrix(!0,!1),Wo.setFromMatrixPosition(this.matrixWorld),this.isCamera||this.isLight?as.lookAt(Wo,hl,this.up):as.lookAt(hl,Wo,this.up),this.quaternion.setFromRotationMatrix(as),s&&(as.extractRotation(s.matrixWorld),Br.setFromRotationMatrix(as),this.quaternion.premultiply(Br.invert()))}add(e){if(arguments.length>1){for(let t=0;t<arguments.length;t++)this.add(arguments[t]);return this}return e===this?(at("Object3D.add: object can't be added as a child of itself.",e),this):(e&&e.isObject3D?(e.removeFromParent(),e.parent=this,this.children.push(e),e.dispatchEvent(Ip),kr.child=e,this.dispatchEvent(kr),kr.child=null):at("Object3D.add: object not an instance of THREE.Object3D.",e),this)}remove(e){if(arguments.length>1){for(let n=0;n<arguments.length;n++)this.remove(arguments[n]);return this}let t=this.children.indexOf(e);return t!==-1&&(e.parent=null,this.children.splice(t,1),e.dispatchEvent(j_),Au.child=e,this.dispatchEvent(Au),Au.child=null),this}removeFromParent(){let e=this.parent;return e!==null&&e.remove(this),this}clear(){return this.remove(...this.children)}attach(e){return this.updateWorldMatrix(!0,!1),as.copy(this.matrixWorld).invert(),e.parent!==null&&(e.parent.updateWorldMatrix(!0,!1),as.multiply(e.parent.matrixWorld)),e.applyMatrix4(as),e.removeFromParent(),e.parent=this,this.children.push(e),e.updateWorldMatrix(!1,!0),e.dispatchEvent(Ip),kr.child=e,this.dispatchEvent(kr),kr.child=null,this}getObjectById(e){return this.getObjectByProperty("id",e)}getObjectByName(e){return this.getObjectByProperty("name",e)}getObjectByProperty(e,t){if(this[e]===t)return this;for(let n=0,s=this.children.length;n<s;n++){let o=this.children[n].getObjectByProperty(e,t);if(o!==void 0)return o}}getObjectsByProperty(e,t,n=[]){this[e]===t&&n.push(this);let s=this.children;for(let r=0,o=s.length;r<o;r++)s[r].getObjectsByProperty(e,t,n);return n}getWorldPosition(e){return this.updateWorldMatrix(!0,!1),e.setFromMatrixPosition(this.matrixWorld)}getWorldQuaternion(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Wo,e,K_),e}getWorldScale(e){return this.updateWorldMatrix(!0,!1),this.matrixWorld.decompose(Wo,Q_,e),e}getWorldDirection(e){this.updateWorldMatrix(!0,!1);let t=this.matrixWorld.elements;return e.set(t[8],t[9],t[10]).normalize()}raycast(){}intersectsFrustum(){return!0}traverse(e){e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverse(e)}traverseVisible(e){if(this.visible===!1)return;e(this);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].traverseVisible(e)}traverseAncestors(e){let t=this.parent;t!==null&&(e(t),t.traverseAncestors(e))}updateMatrix(){this.matrix.compose(this.position,this.quaternion,this.scale);let e=this.pivot;if(e!==null){let t=e.x,n=e.y,s=e.z,r=this.matrix.elements;r[12]+=t-r[0]*t-r[4]*n-r[8]*s,r[13]+=n-r[1]*t-r[5]*n-r[9]*s,r[14]+=s-r[2]*t-r[6]*n-r[10]*s}this.matrixWorldNeedsUpdate=!0}updateMatrixWorld(e){this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||e)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,e=!0);let t=this.children;for(let n=0,s=t.length;n<s;n++)t[n].updateMatrixWorld(e)}updateWorldMatrix(e,t,n=!1){let s=this.parent;if(e===!0&&s!==null&&s.updateWorldMatrix(!0,!1),this.matrixAutoUpdate&&this.updateMatrix(),(this.matrixWorldNeedsUpdate||n)&&(this.matrixWorldAutoUpdate===!0&&(this.parent===null?this.matrixWorld.copy(this.matrix):this.matrixWorld.multiplyMatrices(this.parent.matrixWorld,this.matrix)),this.matrixWorldNeedsUpdate=!1,n=!0),t===!0){let r=this.children;for(let o=0,a=r.length;o<a;o++)r[o].updateWorldMatrix(!1,!0,n)}}toJSON(e){let t=e===void 0||typeof e=="string",n={};t&&(e={geometries:{},materials:{},textures:{},images:{},shapes:{},skeletons:{},animations:{},nodes:{}},n.metadata={version:4.7,type:"Object",generator:"Object3D.toJSON"});let s={};s.uuid=this.uuid,s.type=this.type,s.name=this.name,s.castShadow=this.castShadow,s.receiveShadow=this.receiveShadow,s.visible=this.visible,s.frustumCulled=this.frustumCulled,s.renderOrder=this.renderOrder,s.static=this.static,s.matrixAutoUpdate=this.matrixAutoUpdate,Object.keys(this.userData).length>0&&(s.userData=this.userData),s.layers=this.layers.mask,s.matrix=this.matrix.toArray(),s.up=this.up.toArray(),this.pivot!==null&&(s.pivot=this.pivot.toArray()),this.morphTargetDictionary!==void 0&&(s.morphTargetDictionary=Object.assign({},this.morphTargetDictionary)),this.morphTargetInfluences!==void 0&&(s.morphTargetInfluences=this.morphTargetInfluences.slice()),this.isInstancedMesh&&(s.type="InstancedMesh",s.count=this.count,s.instanceMatrix=this.instanceMatrix.toJSON(),this.instanceColor!==null&&(s.instanceColor=this.instanceColor.toJSON())),this.isBatchedMesh&&(s.type="BatchedMesh",s.perObjectFrustumCulled=this.perObjectFrustumCulled,s.sortObjects=this.sortObjects,s.drawRanges=this._drawRanges,s.reservedRanges=this._reservedRanges,s.geometryInfo=this._geometryInfo.map(a=>({...a,boundingBox:a.boundingBox?a.boundingBox.toJSON():void 0,boundingSphere:a.boundingSphere?a.boundingSphere.toJSON():void 0})),s.instanceInfo=this._instanceInfo.map(a=>({...a})),s.availableInstanceIds=this._availableInstanceIds.slice(),s.availableGeometryIds=this._availableGeometryIds.slice(),s.nextIndexStart=this._nextIndexStart,s.nextVertexStart=this._nextVertexStart,s.geometryCount=this._geometryCount,s.maxInstanceCount=this._maxInstanceCount,s.maxVertexCount=this._maxVertexCount,s.maxIndexCount=this._maxIndexCount,s.geometryInitialized=this._geometryInitialized,s.matricesTexture=this._matricesTexture.toJSON(e),s.indirectTexture=this._indirectTexture.toJSON(e),this._colorsTexture!==null&&(s.colorsTexture=this._colorsTexture.toJSON(e)),this.boundingSphere!==null&&(s.boundingSphere=this.boundingSphere.toJSON()),this.boundingBox!==null&&(s.boundingBox=this.boundingBox.toJSON()));function r(a,l){return a[l.uuid]===void 0&&(a[l.uuid]=l.toJSON(e)),l.uuid}if(this.isScene)this.background&&(this.background.isColor?s.background=this.background.toJSON():this.background.isTexture&&(s.background=this.background.toJSON(e).uuid)),this.environment&&this.environment.isTexture&&this.environment.isRenderTargetTexture!==!0&&(s.environment=this.environment.toJSON(e).uuid);else if(this.isMesh||this.isLine||this.isPoints){s.geometry=r(e.geometries,this.geometry);let a=this.geometry.parameters;if(a!==void 0&&a.shapes!==void 0){let l=a.shapes;if(Array.isArray(l))for(let c=0,h=l.length;c<h;c++){let d=l[c];r(e.shapes,d)}else r(e.shapes,l)}}if(this.isSkinnedMesh&&(s.bindMode=this.bindMode,s.bindMatrix=this.bindMatrix.toArray(),this.skeleton!==void 0&&(r(e.skeletons,this.skeleton),s.skeleton=this.skeleton.uuid)),this.material!==void 0)if(Array.isArray(this.material)){let a=[];for(let l=0,c=this.material.length;l<c;l++)a.push(r(e.materials,this.material[l]));s.material=a}else s.material=r(e.materials,this.material);if(this.children.length>0){s.children=[];for(let a=0;a<this.children.length;a++)s.children.push(this.children[a].toJSON(e).object)}if(this.animations.length>0){s.animations=[];for(let a=0;a<this.animations.length;a++){let l=this.animations[a];s.animations.push(r(e.animations,l))}}if(t){let a=o(e.geometries),l=o(e.materials),c=o(e.textures),h=o(e.images),d=o(e.shapes),u=o(e.skeletons),f=o(e.animations),p=o(e.nodes);a.length>0&&(n.geometries=a),l.length>0&&(n.materials=l),c.length>0&&(n.textures=c),h.length>0&&(n.images=h),d.length>0&&(n.shapes=d),u.length>0&&(n.skeletons=u),f.length>0&&(n.animations=f),p.length>0&&(n.nodes=p)}return n.object=s,n;function o(a){let l=[];for(let c in a){let h=a[c];delete h.metadata,l.push(h)}return l}}clone(e){return new this.constructor().copy(this,e)}copy(e,t=!0){if(this.name=e.name,this.up.copy(e.up),this.position.copy(e.position),this.rotation.order=e.rotation.order,this.quaternion.copy(e.quaternion),this.scale.copy(e.scale),this.pivot=e.pivot!==null?e.pivot.clone():null,this.matrix.copy(e.matrix),this.matrixWorld.copy(e.matrixWorld),this.matrixAutoUpdate=e.matrixAutoUpdate,this.matrixWorldAutoUpdate=e.matrixWorldAutoUpdate,this.matrixWorldNeedsUpdate=e.matrixWorldNeedsUpdate,this.layers.mask=e.layers.mask,this.visible=e.visible,this.castShadow=e.castShadow,this.receiveShadow=e.receiveShadow,this.frustumCulled=e.frustumCulled,this.renderOrder=e.renderOrder,this.static=e.static,this.animations=e.animations.slice(),this.userData=JSON.parse(JSON.stringify(e.userData)),t===!0)for(let n=0;n<e.children.length;n++){let s=e.children[n];this.add(s.clone())}return this}dispose(){this.dispatchEvent({type:"dispose"})}};In.DEFAULT_UP=new X(0,1,0);In.DEFAULT_MATRIX_AUTO_UPDATE=!0;In.DEFAULT_MATRIX_WORLD_AUTO_UPDATE=!0;var Yi=class extends In{constructor(){super(),this.isGroup=!0,this.type="Group"}},ev={type:"move"},so=class{constructor(){this._targetRay=null,this._grip=null,this._hand=null}getHandSpace(){return this._hand===null&&(this._hand=new Yi,this._hand.matrixAutoUpdate=!1,this._hand.visible=!1,this._hand.joints={},this._hand.inputState={pinching:!1}),this._hand}getTargetRaySpace(){return this._targetRay===null&&(this._targetRay=new Yi,this._targetRay.matrixAutoUpdate=!1,this._targetRay.visible=!1,this._targetRay.hasLinearVelocity=!1,this._targetRay.linearVelocity=new X,this._targetRay.hasAngularVelocity=!1,this._targetRay.angularVelocity=new X),this._targetRay}getGripSpace(){return this._grip===null&&(this._grip=new Yi,this._grip.matrixAutoUpdate=!1,this._grip.visible=!1,this._grip.hasLinearVelocity=!1,this._grip.linearVelocity=new X,this._grip.hasAngularVelocity=!1,this._grip.angularVelocity=new X,this._grip.eventsEnabled=!1),this._grip}dispatchEvent(e){return this._targetRay!==null&&this._targetRay.dispatchEvent(e),this._grip!==null&&this._grip.dispatchEvent(e),this._hand!==null&&this._hand.dispatchEvent(e),this}connect(e){if(e&&e.hand){let t=this._hand;if(t)for(let n of e.hand.values())this._getHandJoint(t,n)}return this.dispatchEvent({type:"connected",data:e}),this}disconnect(e){return this.dispatchEvent({type:"disconnected",data:e}),this._targetRay!==null&&(this._targetRay.visible=!1),this._grip!==null&&(this._grip.visible=!1),this._hand!==null&&(this._hand.visible=!1),this}update(e,t,n){let s=null,r=null,o=null,a=this._targetRay,l=this._grip,c=this._hand;if(e&&t.session.visibilityState!=="visible-blurred"){if(c&&e.hand){o=!0;for(let x of e.hand.values()){let m=t.getJointPose(x,n),g=this._getHandJoint(c,x);m!==null&&(g.matrix.fromArray(m.transform.matrix),g.matrix.decompose(g.position,g.quaternion,g.scale),g.matrixWorldNeedsUpdate=!0,g.jointRadius=m.radius),g.visible=m!==null}let h=c.joints["index-finger-tip"],d=c.joints["thumb-tip"],u=h.position.distanceTo(d.position),f=.02,p=.005;c.inputState.pinching&&u>f+p?(c.inputState.pinching=!1,this.dispatchEvent({type:"pinchend",handedness:e.handedness,target:this})):!c.inputState.pinching&&u<=f-p&&(c.inputState.pinching=!0,this.dispatchEvent({type:"pinchstart",handedness:e.handedness,target:this}))}else l!==null&&e.gripSpace&&(r=t.getPose(e.gripSpace,n),r!==null&&(l.matrix.fromArray(r.transform.matrix),l.matrix.decompose(l.position,l.quaternion,l.scale),l.matrixWorldNeedsUpdate=!0,r.linearVelocity?(l.hasLinearVelocity=!0,l.linearVelocity.copy(r.linearVelocity)):l.hasLinearVelocity=!1,r.angularVelocity?(l.hasAngularVelocity=!0,l.angularVelocity.copy(r.angularVelocity)):l.hasAngularVelocity=!1,l.eventsEnabled&&l.dispatchEvent({type:"gripUpdated",data:e,target:this})));a!==null&&(s=t.getPose(e.targetRaySpace,n),s===null&&r!==null&&(s=r),s!==null&&(a.matrix.fromArray(s.transform.matrix),a.matrix.decompose(a.position,a.quaternion,a.scale),a.matrixWorldNeedsUpdate=!0,s.linearVelocity?(a.hasLinearVelocity=!0,a.linearVelocity.copy(s.linearVelocity)):a.hasLinearVelocity=!1,s.angularVelocity?(a.hasAngularVelocity=!0,a.angularVelocity.copy(s.angularVelocity)):a.hasAngularVelocity=!1,this.dispatchEvent(ev)))}return a!==null&&(a.visible=s!==null),l!==null&&(l.visible=r!==null),c!==null&&(c.visible=o!==null),this}_getHandJoint(e,t){if(e.joints[t.jointName]===void 0){let n=new Yi;n.matrixAutoUpdate=!1,n.visible=!1,e.joints[t.jointName]=n,e.add(n)}return e.joints[t.jointName]}},Gm={aliceblue:15792383,antiquewhite:16444375,aqua:65535,aquamarine:8388564,azure:15794175,beige:16119260,bisque:16770244,black:0,blanchedalmond:16772045,blue:255,blueviolet:9055202,brown:10824234,burlywood:14596231,cadetblue:6266528,chartreuse:8388352,chocolate:13789470,coral:16744272,cornflowerblue:6591981,cornsilk:16775388,crimson:14423100,cyan:65535,darkblue:139,darkcyan:35723,darkgoldenrod:12092939,darkgray:11119017,darkgreen:25600,darkgrey:11119017,darkkhaki:12433259,darkmagenta:9109643,darkolivegreen:5597999,darkorange:16747520,darkorchid:10040012,darkred:9109504,darksalmon:15308410,darkseagreen:9419919,darkslateblue:4734347,darkslategray:3100495,darkslategrey:3100495,darkturquoise:52945,darkviolet:9699539,deeppink:16716947,deepskyblue:49151,dimgray:6908265,dimgrey:6908265,dodgerblue:2003199,firebrick:11674146,floralwhite:16775920,forestgreen:2263842,fuchsia:16711935,gainsboro:14474460,ghostwhite:16316671,gold:16766720,goldenrod:14329120,gray:8421504,green:32768,greenyellow:11403055,grey:8421504,honeydew:15794160,hotpink:16738740,indianred:13458524,indigo:4915330,ivory:16777200,khaki:15787660,lavender:15132410,lavenderblush:16773365,lawngreen:8190976,lemonchiffon:16775885,lightblue:11393254,lightcoral:15761536,lightcyan:14745599,lightgoldenrodyellow:16448210,lightgray:13882323,lightgreen:9498256,lightgrey:13882323,lightpink:16758465,lightsalmon:16752762,lightseagreen:2142890,lightskyblue:8900346,lightslategray:7833753,lightslategrey:7833753,lightsteelblue:11584734,lightyellow:16777184,lime:65280,limegreen:3329330,linen:16445670,magenta:16711935,maroon:8388608,mediumaquamarine:6737322,mediumblue:205,mediumorchid:12211667,mediumpurple:9662683,mediumseagreen:3978097,mediumslateblue:8087790,mediumspringgreen:64154,mediumturquoise:4772300,mediumvioletred:13047173,midnightblue:1644912,mintcream:16121850,mistyrose:16770273,moccasin:16770229,navajowhite:16768685,navy:128,oldlace:16643558,olive:8421376,olivedrab:7048739,orange:16753920,orangered:16729344,orchid:14315734,palegoldenrod:15657130,palegreen:10025880,paleturquoise:11529966,palevioletred:14381203,papayawhip:16773077,peachpuff:16767673,peru:13468991,pink:16761035,plum:14524637,powderblue:11591910,purple:8388736,rebeccapurple:6697881,red:16711680,rosybrown:12357519,royalblue:4286945,saddlebrown:9127187,salmon:16416882,sandybrown:16032864,seagreen:3050327,seashell:16774638,sienna:10506797,silver:12632256,skyblue:8900331,slateblue:6970061,slategray:7372944,slategrey:7372944,snow:16775930,springgreen:65407,steelblue:4620980,tan:13808780,teal:32896,thistle:14204888,tomato:16737095,turquoise:4251856,violet:15631086,wheat:16113331,white:16777215,whitesmoke:16119285,yellow:16776960,yellowgreen:10145074},Is={h:0,s:0,l:0},ul={h:0,s:0,l:0};function Ru(i,e,t){return t<0&&(t+=1),t>1&&(t-=1),t<1/6?i+(e-i)*6*t:t<1/2?e:t<2/3?i+(e-i)*6*(2/3-t):i}var pt=class{constructor(e,t,n){return this.isColor=!0,this.r=1,this.g=1,this.b=1,this.set(e,t,n)}set(e,t,n){if(t===void 0&&n===void 0){let s=e;s&&s.isColor?this.copy(s):typeof s=="number"?this.setHex(s):typeof s=="string"&&this.setStyle(s)}else this.setRGB(e,t,n);return this}setScalar(e){return this.r=e,this.g=e,this.b=e,this}setHex(e,t=$n){return e=Math.floor(e),this.r=(e>>16&255)/255,this.g=(e>>8&255)/255,this.b=(e&255)/255,Tt.colorSpaceToWorking(this,t),this}setRGB(e,t,n,s=Tt.workingColorSpace){return this.r=e,this.g=t,this.b=n,Tt.colorSpaceToWorking(this,s),this}setHSL(e,t,n,s=Tt.workingColorSpace){if(e=W_(e,1),t=wt(t,0,1),n=wt(n,0,1),t===0)this.r=this.g=this.b=n;else{let r=n<=.5?n*(1+t):n+t-n*t,o=2*n-r;this.r=Ru(o,r,e+1/3),this.g=Ru(o,r,e),this.b=Ru(o,r,e-1/3)}return Tt.colorSpaceToWorking(this,s),this}setStyle(e,t=$n){function n(r){r!==void 0&&parseFloat(r)<1&&tt("Color: Alpha component of "+e+" will be ignored.")}let s;if(s=/^(\w+)\(([^\)]*)\)/.exec(e)){let r,o=s[1],a=s[2];switch(o){case"rgb":case"rgba":if(r=/^\s*(\d+)\s*,\s*(\d+)\s*,\s*(\d+)\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(255,parseInt(r[1],10))/255,Math.min(255,parseInt(r[2],10))/255,Math.min(255,parseInt(r[3],10))/255,t);if(r=/^\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setRGB(Math.min(100,parseFloat(r[1]))/100,Math.min(100,parseFloat(r[2]))/100,Math.min(100,parseFloat(r[3]))/100,t);break;case"hsl":case"hsla":if(r=/^\s*([+-]?(?:\d+(?:\.\d+)?|\.\d+))\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*,\s*(\d+(?:\.\d+)?|\.\d+)\%\s*(?:,\s*(\d+(?:\.\d+)?|\.\d+)\s*)?$/.exec(a))return n(r[4]),this.setHSL(parseFloat(r[1])/360,parseFloat(r[2])/100,parseFloat(r[3])/100,t);break;default:tt("Color: Unknown color model "+e)}}else if(s=/^\#([A-Fa-f\d]+)$/.exec(e)){let r=s[1],o=r.length;if(o===3)return this.setRGB(parseInt(r.charAt(0),16)/15,parseInt(r.charAt(1),16)/15,parseInt(r.charAt(2),16)/15,t);if(o===6)return this.setHex(parseInt(r,16),t);tt("Color: Invalid hex color "+e)}else if(e&&e.length>0)return this.setColorName(e,t);return this}setColorName(e,t=$n){let n=Gm[e.toLowerCase()];return n!==void 0?this.setHex(n,t):tt("Color: Unknown color "+e),this}clone(){return new this.constructor(this.r,this.g,this.b)}copy(e){return this.r=e.r,this.g=e.g,this.b=e.b,this}copySRGBToLinear(e){return this.r=ds(e.r),this.g=ds(e.g),this.b=ds(e.b),this}copyLinearToSRGB(e){return this.r=jr(e.r),this.g=jr(e.g),this.b=jr(e.b),this}convertSRGBToLinear(){return this.copySRGBToLinear(this),this}convertLinearToSRGB(){return this.copyLinearToSRGB(this),this}getHex(e=$n){return Tt.workingToColorSpace(Bn.copy(this),e),Math.round(wt(Bn.r*255,0,255))*65536+Math.round(wt(Bn.g*255,0,255))*256+Math.round(wt(Bn.b*255,0,255))}getHexString(e=$n){return("000000"+this.getHex(e).toString(16)).slice(-6)}getHSL(e,t=Tt.workingColorSpace){Tt.workingToColorSpace(Bn.copy(this),t);let n=Bn.r,s=Bn.g,r=Bn.b,o=Math.max(n,s,r),a=Math.min(n,s,r),l,c,h=(a+o)/2;if(a===o)l=0,c=0;else{let d=o-a;switch(c=h<=.5?d/(o+a):d/(2-o-a),o){case n:l=(s-r)/d+(s<r?6:0);break;case s:l=(r-n)/d+2;break;case r:l=(n-s)/d+4;break}l/=6}return e.h=l,e.s=c,e.l=h,e}getRGB(e,t=Tt.workingColorSpace){return Tt.workingToColorSpace(Bn.copy(this),t),e.r=Bn.r,e.g=Bn.g,e.b=Bn.b,e}getStyle(e=$n){Tt.workingToColorSpace(Bn.copy(this),e);let t=Bn.r,n=Bn.g,s=Bn.b;return e!==$n?`color(${e} ${t.toFixed(3)} ${n.toFixed(3)} ${s.toFixed(3)})`:`rgb(${Math.round(t*255)},${Math.round(n*255)},${Math.round(s*255)})`}offsetHSL(e,t,n){return this.getHSL(Is),this.setHSL(Is.h+e,Is.s+t,Is.l+n)}add(e){return this.r+=e.r,this.g+=e.g,this.b+=e.b,this}addColors(e,t){return this.r=e.r+t.r,this.g=e.g+t.g,this.b=e.b+t.b,this}addScalar(e){return this.r+=e,this.g+=e,this.b+=e,this}sub(e){return this.r=Math.max(0,this.r-e.r),this.g=Math.max(0,this.g-e.g),this.b=Math.max(0,this.b-e.b),this}multiply(e){return this.r*=e.r,this.g*=e.g,this.b*=e.b,this}multiplyScalar(e){return this.r*=e,this.g*=e,this.b*=e,this}lerp(e,t){return this.r+=(e.r-this.r)*t,this.g+=(e.g-this.g)*t,this.b+=(e.b-this.b)*t,this}lerpColors(e,t,n){return this.r=e.r+(t.r-e.r)*n,this.g=e.g+(t.g-e.g)*n,this.b=e.b+(t.b-e.b)*n,this}lerpHSL(e,t){this.getHSL(Is),e.getHSL(ul);let n=Mu(Is.h,ul.h,t),s=Mu(Is.s,ul.s,t),r=Mu(Is.l,ul.l,t);return this.setHSL(n,s,r),this}setFromVector3(e){return this.r=e.x,this.g=e.y,this.b=e.z,this}applyMatrix3(e){let t=this.r,n=this.g,s=this.b,r=e.elements;return this.r=r[0]*t+r[3]*n+r[6]*s,this.g=r[1]*t+r[4]*n+r[7]*s,this.b=r[2]*t+r[5]*n+r[8]*s,this}equals(e){return e.r===this.r&&e.g===this.g&&e.b===this.b}fromArray(e,t=0){return this.r=e[t],this.g=e[t+1],this.b=e[t+2],this}toArray(e=[],t=0){return e[t]=this.r,e[t+1]=this.g,e[t+2]=this.b,e}fromBufferAttribute(e,t){return this.r=e.getX(t),this.g=e.getY(t),this.b=e.getZ(t),this}toJSON(){return this.getHex()}*[Symbol.iterator](){yield this.r,yield this.g,yield this.b}},Bn=new pt;pt.NAMES=Gm;var sr=class extends In{constructor(){super(),this.isScene=!0,this.type="Scene",this.background=null,this.environment=null,this.fog=null,this.backgroundBlurriness=0,this.backgroundIntensity=1,this.backgroundRotation=new ps,this.environmentIntensity=1,this.environmentRotation=new ps,this.overrideMaterial=null,typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}copy(e,t){return super.copy(e,t),this.background=e.background!==null?e.background.clone():null,this.environment=e.environment!==null?e.environment.clone():null,this.fog=e.fog!==null?e.fog.clone():null,this.backgroundBlurriness=e.backgroundBlurriness,this.backgroundIntensity=e.backgroundIntensity,this.backgroundRotation.copy(e.backgroundRotation),this.environmentIntensity=e.environmentIntensity,this.environmentRotation.copy(e.environmentRotation),this.overrideMaterial=e.overrideMaterial!==null?e.overrideMaterial.clone():null,this.matrixAutoUpdate=e.matrixAutoUpdate,this}toJSON(e){let t=super.toJSON(e);return this.fog!==null&&(t.object.fog=this.fog.toJSON()),t.object.backgroundBlurriness=this.backgroundBlurriness,t.object.backgroundIntensity=this.backgroundIntensity,t.object.backgroundRotation=this.backgroundRotation.toArray(),t.object.environmentIntensity=this.environmentIntensity,t.object.environmentRotation=this.environmentRotation.toArray(),t}},wi=new X,ls=new X,Cu=new X,cs=new X,zr=new X,Hr=new X,Lp=new X,Pu=new X,Iu=new X,Lu=new X,Du=new tn,Nu=new tn,Uu=new tn,Xi=class i{constructor(e=new X,t=new X,n=new X){this.a=e,this.b=t,this.c=n}static getNormal(e,t,n,s){s.subVectors(n,t),wi.subVectors(e,t),s.cross(wi);let r=s.lengthSq();return r>0?s.multiplyScalar(1/Math.sqrt(r)):s.set(0,0,0)}static getBarycoord(e,t,n,s,r){wi.subVectors(s,t),ls.subVectors(n,t),Cu.subVectors(e,t);let o=wi.dot(wi),a=wi.dot(ls),l=wi.dot(Cu),c=ls.dot(ls),h=ls.dot(Cu),d=o*c-a*a;if(d===0)return r.set(0,0,0),null;let u=1/d,f=(c*l-a*h)*u,p=(o*h-a*l)*u;return r.set(1-f-p,p,f)}static containsPoint(e,t,n,s){return this.getBarycoord(e,t,n,s,cs)===null?!1:cs.x>=0&&cs.y>=0&&cs.x+cs.y<=1}static getInterpolation(e,t,n,s,r,o,a,l){return this.getBarycoord(e,t,n,s,cs)===null?(l.x=0,l.y=0,"z"in l&&(l.z=0),"w"in l&&(l.w=0),null):(l.setScalar(0),l.addScaledVector(r,cs.x),l.addScaledVector(o,cs.y),l.addScaledVector(a,cs.z),l)}static getInterpolatedAttribute(e,t,n,s,r,o){return Du.setScalar(0),Nu.setScalar(0),Uu.setScalar(0),Du.fromBufferAttribute(e,t),Nu.fromBufferAttribute(e,n),Uu.fromBufferAttribute(e,s),o.setScalar(0),o.addScaledVector(Du,r.x),o.addScaledVector(Nu,r.y),o.addScaledVector(Uu,r.z),o}static isFrontFacing(e,t,n,s){return wi.subVectors(n,t),ls.subVectors(e,t),wi.cross(ls).dot(s)<0}set(e,t,n){return this.a.copy(e),this.b.copy(t),this.c.copy(n),this}setFromPointsAndIndices(e,t,n,s){return this.a.copy(e[t]),this.b.copy(e[n]),this.c.copy(e[s]),this}setFromAttributeAndIndices(e,t,n,s){return this.a.fromBufferAttribute(e,t),this.b.fromBufferAttribute(e,n),this.c.fromBufferAttribute(e,s),this}clone(){return new this.constructor().copy(this)}copy(e){return this.a.copy(e.a),this.b.copy(e.b),this.c.copy(e.c),this}getArea(){return wi.subVectors(this.c,this.b),ls.subVectors(this.a,this.b),wi.cross(ls).length()*.5}getMidpoint(e){return e.addVectors(this.a,this.b).add(this.c).multiplyScalar(1/3)}getNormal(e){return i.getNormal(this.a,this.b,this.c,e)}getPlane(e){return e.setFromCoplanarPoints(this.a,this.b,this.c)}getBarycoord(e,t){return i.getBarycoord(e,this.a,this.b,this.c,t)}getInterpolation(e,t,n,s,r){return i.getInterpolation(e,this.a,this.b,this.c,t,n,s,r)}containsPoint(e){return i.containsPoint(e,this.a,this.b,this.c)}isFrontFacing(e){return i.isFrontFacing(this.a,this.b,this.c,e)}intersectsBox(e){return e.intersectsTriangle(this)}closestPointToPoint(e,t){let n=this.a,s=this.b,r=this.c,o,a;zr.subVectors(s,n),Hr.subVectors(r,n),Pu.subVectors(e,n);let l=zr.dot(Pu),c=Hr.dot(Pu);if(l<=0&&c<=0)return t.copy(n);Iu.subVectors(e,s);let h=zr.dot(Iu),d=Hr.dot(Iu);if(h>=0&&d<=h)return t.copy(s);let u=l*d-h*c;if(u<=0&&l>=0&&h<=0&&l-h>0)return o=l/(l-h),t.copy(n).addScaledVector(zr,o);Lu.subVectors(e,r);let f=zr.dot(Lu),p=Hr.dot(Lu);if(p>=0&&f<=p)return t.copy(r);let x=f*c-l*p;if(x<=0&&c>=0&&p<=0)return a=c/(c-p),t.copy(n).addScaledVector(Hr,a);let m=h*p-f*d;if(m<=0&&d-h>=0&&f-p>=0)return Lp.subVectors(r,s),a=(d-h)/(d-h+(f-p)),t.copy(s).addScaledVector(Lp,a);let g=1/(m+x+u);return o=x*g,a=u*g,t.copy(n).addScaledVector(zr,o).addScaledVector(Hr,a)}equals(e){return e.a.equals(this.a)&&e.b.equals(this.b)&&e.c.equals(this.c)}},Us=class{constructor(e=new X(1/0,1/0,1/0),t=new X(-1/0,-1/0,-1/0)){this.isBox3=!0,this.min=e,this.max=t}set(e,t){return this.min.copy(e),this.max.copy(t),this}setFromArray(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t+=3)this.expandByPoint(Ei.fromArray(e,t));return this}setFromBufferAttribute(e){this.makeEmpty();for(let t=0,n=e.count;t<n;t++)this.expandByPoint(Ei.fromBufferAttribute(e,t));return this}setFromPoints(e){this.makeEmpty();for(let t=0,n=e.length;t<n;t++)this.expandByPoint(e[t]);return this}setFromCenterAndSize(e,t){let n=Ei.copy(t).multiplyScalar(.5);return this.min.copy(e).sub(n),this.max.copy(e).add(n),this}setFromObject(e,t=!1){return this.makeEmpty(),this.expandByObject(e,t)}clone(){return new this.constructor().copy(this)}copy(e){return this.min.copy(e.min),this.max.copy(e.max),this}makeEmpty(){return this.min.x=this.min.y=this.min.z=1/0,this.max.x=this.max.y=this.max.z=-1/0,this}isEmpty(){return this.max.x<this.min.x||this.max.y<this.min.y||this.max.z<this.min.z}getCenter(e){return this.isEmpty()?e.set(0,0,0):e.addVectors(this.min,this.max).multiplyScalar(.5)}getSize(e){return this.isEmpty()?e.set(0,0,0):e.subVectors(this.max,this.min)}expandByPoint(e){return this.min.min(e),this.max.max(e),this}expandByVector(e){return this.min.sub(e),this.max.add(e),this}expandByScalar(e){return this.min.addScalar(-e),this.max.addScalar(e),this}expandByObject(e,t=!1){e.updateWorldMatrix(!1,!1);let n=e.geometry;if(n!==void 0){let r=n.getAttribute("position");if(t===!0&&r!==void 0&&e.isInstancedMesh!==!0&&e.isBatchedMesh!==!0)for(let o=0,a=r.count;o<a;o++)e.isMesh===!0?e.getVertexPosition(o,Ei):Ei.fromBufferAttribute(r,o),Ei.applyMatrix4(e.matrixWorld),this.expandByPoint(Ei);else e.boundingBox!==void 0?(e.boundingBox===null&&e.computeBoundingBox(),dl.copy(e.boundingBox)):(n.boundingBox===null&&n.computeBoundingBox(),dl.copy(n.boundingBox)),dl.applyMatrix4(e.matrixWorld),this.union(dl)}let s=e.children;for(let r=0,o=s.length;r<o;r++)this.expandByObject(s[r],t);return this}containsPoint(e){return e.x>=this.min.x&&e.x<=this.max.x&&e.y>=this.min.y&&e.y<=this.max.y&&e.z>=this.min.z&&e.z<=this.max.z}containsBox(e){return this.min.x<=e.min.x&&e.max.x<=this.max.x&&this.min.y<=e.min.y&&e.max.y<=this.max.y&&this.min.z<=e.min.z&&e.max.z<=this.max.z}getParameter(e,t){return t.set((e.x-this.min.x)/(this.max.x-this.min.x),(e.y-this.min.y)/(this.max.y-this.min.y),(e.z-this.min.z)/(this.max.z-this.min.z))}intersectsBox(e){return e.max.x>=this.min.x&&e.min.x<=this.max.x&&e.max.y>=this.min.y&&e.min.y<=this.max.y&&e.max.z>=this.min.z&&e.min.z<=this.max.z}intersectsSphere(e){return this.clampPoint(e.center,Ei),Ei.distanceToSquared(e.center)<=e.radius*e.radius}intersectsPlane(e){let t,n;return e.normal.x>0?(t=e.normal.x*this.min.x,n=e.normal.x*this.max.x):(t=e.normal.x*this.max.x,n=e.normal.x*this.min.x),e.normal.y>0?(t+=e.normal.y*this.min.y,n+=e.normal.y*this.max.y):(t+=e.normal.y*this.max.y,n+=e.normal.y*this.min.y),e.normal.z>0?(t+=e.normal.z*this.min.z,n+=e.normal.z*this.max.z):(t+=e.normal.z*this.max.z,n+=e.normal.z*this.min.z),t<=-e.constant&&n>=-e.constant}intersectsTriangle(e){if(this.isEmpty())return!1;this.getCenter(Xo),fl.subVectors(this.max,Xo),Gr.subVectors(e.a,Xo),Vr.subVectors(e.b,Xo),Wr.subVectors(e.c,Xo),Ls.subVectors(Vr,Gr),Ds.subVectors(Wr,Vr),js.subVectors(Gr,Wr);let t=[0,-Ls.z,Ls.y,0,-Ds.z,Ds.y,0,-js.z,js.y,Ls.z,0,-Ls.x,Ds.z,0,-Ds.x,js.z,0,-js.x,-Ls.y,Ls.x,0,-Ds.y,Ds.x,0,-js.y,js.x,0];return!Fu(t,Gr,Vr,Wr,fl)||(t=[1,0,0,0,1,0,0,0,1],!Fu(t,Gr,Vr,Wr,fl))?!1:(pl.crossVectors(Ls,Ds),t=[pl.x,pl.y,pl.z],Fu(t,Gr,Vr,Wr,fl))}clampPoint(e,t){return t.copy(e).clamp(this.min,this.max)}distanceToPoint(e){return this.clampPoint(e,Ei).distanceTo(e)}getBoundingSphere(e){return this.isEmpty()?e.makeEmpty():(this.getCenter(e.center),e.radius=this.getSize(Ei).length()*.5),e}intersect(e){return this.min.max(e.min),this.max.min(e.max),this.isEmpty()&&this.makeEmpty(),this}union(e){return this.min.min(e.min),this.max.max(e.max),this}applyMatrix4(e){return this.isEmpty()?this:(hs[0].set(this.min.x,this.min.y,this.min.z).applyMatrix4(e),hs[1].set(this.min.x,this.min.y,this.max.z).applyMatrix4(e),hs[2].set(this.min.x,this.max.y,this.min.z).applyMatrix4(e),hs[3].set(this.min.x,this.max.y,this.max.z).applyMatrix4(e),hs[4].set(this.max.x,this.min.y,this.min.z).applyMatrix4(e),hs[5].set(this.max.x,this.min.y,this.max.z).applyMatrix4(e),hs[6].set(this.max.x,this.max.y,this.min.z).applyMatrix4(e),hs[7].set(this.max.x,this.max.y,this.max.z).applyMatrix4(e),this.setFromPoints(hs),this)}translate(e){return this.min.add(e),this.max.add(e),this}equals(e){return e.min.equals(this.min)&&e.max.equals(this.max)}toJSON(){return{min:this.min.toArray(),max:this.max.toArray()}}fromJSON(e){return this.min.fromArray(e.min),this.max.fromArray(e.max),this}},hs=[new X,new X,new X,new X,new X,new X,new X,new X],Ei=new X,dl=new Us,Gr=new X,Vr=new X,Wr=new X,Ls=new X,Ds=new X,js=new X,Xo=new X,fl=new X,pl=new X,er=new X;function Fu(i,e,t,n,s){for(let r=0,o=i.length-3;r<=o;r+=3){er.fromArray(i,r);let a=s.x*Math.abs(er.x)+s.y*Math.abs(er.y)+s.z*Math.abs(er.z),l=e.dot(er),c=t.dot(er),h=n.dot(er);if(Math.max(-Math.max(l,c,h),Math.min(l,c,h))>a)return!1}return!0}var mn=new X,ml=new De,tv=0,Un=class extends $i{constructor(e,t,n=!1){if(super(),Array.isArray(e))throw new TypeError("THREE.BufferAttribute: array should be a Typed Array.");this.isBufferAttribute=!0,Object.defineProperty(this,"id",{value:tv++}),this.name="",this.array=e,this.itemSize=t,this.count=e!==void 0?e.length/t:0,this.normalized=n,this.usage=Pd,this.updateRanges=[],this.gpuType=Pi,this.version=0,this._normalizationScale=e!==void 0?mh(e):void 0}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.name=e.name,this.array=new e.array.constructor(e.array),this.itemSize=e.itemSize,this.count=e.count,this.normalized=e.normalized,this.usage=e.usage,this.gpuType=e.gpuType,this._normalizationScale=e._normalizationScale,this}copyAt(e,t,n){e*=this.itemSize,n*=t.itemSize;for(let s=0,r=this.itemSize;s<r;s++)this.array[e+s]=t.array[n+s];return this}copyArray(e){return this.array.set(e),this}applyMatrix3(e){if(this.itemSize===2)for(let t=0,n=this.count;t<n;t++)ml.fromBufferAttribute(this,t),ml.applyMatrix3(e),this.setXY(t,ml.x,ml.y);else if(this.itemSize===3)for(let t=0,n=this.count;t<n;t++)mn.fromBufferAttribute(this,t),mn.applyMatrix3(e),this.setXYZ(t,mn.x,mn.y,mn.z);return this}applyMatrix4(e){for(let t=0,n=this.count;t<n;t++)mn.fromBufferAttribute(this,t),mn.applyMatrix4(e),this.setXYZ(t,mn.x,mn.y,mn.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)mn.fromBufferAttribute(this,t),mn.applyNormalMatrix(e),this.setXYZ(t,mn.x,mn.y,mn.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)mn.fromBufferAttribute(this,t),mn.transformDirection(e),this.setXYZ(t,mn.x,mn.y,mn.z);return this}set(e,t=0){return this.array.set(e,t),this}getComponent(e,t){let n=this.array[e*this.itemSize+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.array[e*this.itemSize+t]=n,this}getX(e){let t=this.array[e*this.itemSize];return this.normalized&&(t=this._denormalize(t)),t}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize]=t,this}getY(e){let t=this.array[e*this.itemSize+1];return this.normalized&&(t=this._denormalize(t)),t}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+1]=t,this}getZ(e){let t=this.array[e*this.itemSize+2];return this.normalized&&(t=this._denormalize(t)),t}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+2]=t,this}getW(e){let t=this.array[e*this.itemSize+3];return this.normalized&&(t=this._denormalize(t)),t}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.array[e*this.itemSize+3]=t,this}setXY(e,t,n){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.array[e+0]=t,this.array[e+1]=n,this}setXYZ(e,t,n,s){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e*=this.itemSize,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.array[e+0]=t,this.array[e+1]=n,this.array[e+2]=s,this.array[e+3]=r,this}onUpload(e){return this.onUploadCallback=e,this}clone(){return new this.constructor(this.array,this.itemSize).copy(this)}toJSON(){let e={itemSize:this.itemSize,type:this.array.constructor.name,array:Array.from(this.array),normalized:this.normalized};return e.name=this.name,e.usage=this.usage,e.gpuType=this.gpuType,e}dispose(){this.dispatchEvent({type:"dispose"})}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):zm(e,this.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Hm(e,this.array)}};var ca=class extends Un{constructor(e,t,n){super(new Uint16Array(e),t,n)}};var ha=class extends Un{constructor(e,t,n){super(new Uint32Array(e),t,n)}};var Lt=class extends Un{constructor(e,t,n){super(new Float32Array(e),t,n)}},nv=new Us,qo=new X,Ou=new X,rr=class{constructor(e=new X,t=-1){this.isSphere=!0,this.center=e,this.radius=t}set(e,t){return this.center.copy(e),this.radius=t,this}setFromPoints(e,t){let n=this.center;t!==void 0?n.copy(t):nv.setFromPoints(e).getCenter(n);let s=0;for(let r=0,o=e.length;r<o;r++)s=Math.max(s,n.distanceToSquared(e[r]));return this.radius=Math.sqrt(s),this}copy(e){return this.center.copy(e.center),this.radius=e.radius,this}isEmpty(){return this.radius<0}makeEmpty(){return this.center.set(0,0,0),this.radius=-1,this}containsPoint(e){return e.distanceToSquared(this.center)<=this.radius*this.radius}distanceToPoint(e){return e.distanceTo(this.center)-this.radius}intersectsSphere(e){let t=this.radius+e.radius;return e.center.distanceToSquared(this.center)<=t*t}intersectsBox(e){return e.intersectsSphere(this)}intersectsPlane(e){return Math.abs(e.distanceToPoint(this.center))<=this.radius}clampPoint(e,t){let n=this.center.distanceToSquared(e);return t.copy(e),n>this.radius*this.radius&&(t.sub(this.center).normalize(),t.multiplyScalar(this.radius).add(this.center)),t}getBoundingBox(e){return this.isEmpty()?(e.makeEmpty(),e):(e.set(this.center,this.center),e.expandByScalar(this.radius),e)}applyMatrix4(e){return this.center.applyMatrix4(e),this.radius=this.radius*e.getMaxScaleOnAxis(),this}translate(e){return this.center.add(e),this}expandByPoint(e){if(this.isEmpty())return this.center.copy(e),this.radius=0,this;qo.subVectors(e,this.center);let t=qo.lengthSq();if(t>this.radius*this.radius){let n=Math.sqrt(t),s=(n-this.radius)*.5;this.center.addScaledVector(qo,s/n),this.radius+=s}return this}union(e){return e.isEmpty()?this:this.isEmpty()?(this.copy(e),this):(this.center.equals(e.center)===!0?this.radius=Math.max(this.radius,e.radius):(Ou.subVectors(e.center,this.center).setLength(e.radius),this.expandByPoint(qo.copy(e.center).add(Ou)),this.expandByPoint(qo.copy(e.center).sub(Ou))),this)}equals(e){return e.center.equals(this.center)&&e.radius===this.radius}clone(){return new this.constructor().copy(this)}toJSON(){return{radius:this.radius,center:this.center.toArray()}}fromJSON(e){return this.radius=e.radius,this.center.fromArray(e.center),this}},iv=0,mi=new Ft,Bu=new In,Xr=new X,ri=new Us,Yo=new Us,Cn=new X,Jt=class i extends $i{constructor(){super(),this.isBufferGeometry=!0,Object.defineProperty(this,"id",{value:iv++}),this.uuid=Vs(),this.name="",this.type="BufferGeometry",this.index=null,this.indirect=null,this.indirectOffset=0,this.attributes={},this.morphAttributes={},this.morphTargetsRelative=!1,this.groups=[],this.boundingBox=null,this.boundingSphere=null,this.drawRange={start:0,count:1/0},this.userData={},this._transformed=!1}getIndex(){return this.index}setIndex(e){return Array.isArray(e)?this.index=new(G_(e)?ha:ca)(e,1):this.index=e,this}setIndirect(e,t=0){return this.indirect=e,this.indirectOffset=t,this}getIndirect(){return this.indirect}getAttribute(e){return this.attributes[e]}setAttribute(e,t){return this.attributes[e]=t,this}deleteAttribute(e){return delete this.attributes[e],this}hasAttribute(e){return this.attributes[e]!==void 0}addGroup(e,t,n=0){this.groups.push({start:e,count:t,materialIndex:n})}clearGroups(){this.groups=[]}setDrawRange(e,t){this.drawRange.start=e,this.drawRange.count=t}applyMatrix4(e){let t=this.attributes.position;t!==void 0&&(t.applyMatrix4(e),t.needsUpdate=!0);let n=this.attributes.normal;if(n!==void 0){let r=new ft().getNormalMatrix(e);n.applyNormalMatrix(r),n.needsUpdate=!0}let s=this.attributes.tangent;return s!==void 0&&(s.transformDirection(e),s.needsUpdate=!0),this.boundingBox!==null&&this.computeBoundingBox(),this.boundingSphere!==null&&this.computeBoundingSphere(),this._transformed=!0,this}applyQuaternion(e){return mi.makeRotationFromQuaternion(e),this.applyMatrix4(mi),this}rotateX(e){return mi.makeRotationX(e),this.applyMatrix4(mi),this}rotateY(e){return mi.makeRotationY(e),this.applyMatrix4(mi),this}rotateZ(e){return mi.makeRotationZ(e),this.applyMatrix4(mi),this}translate(e,t,n){return mi.makeTranslation(e,t,n),this.applyMatrix4(mi),this}scale(e,t,n){return mi.makeScale(e,t,n),this.applyMatrix4(mi),this}lookAt(e){return Bu.lookAt(e),Bu.updateMatrix(),this.applyMatrix4(Bu.matrix),this}center(){return this.computeBoundingBox(),this.boundingBox.getCenter(Xr).negate(),this.translate(Xr.x,Xr.y,Xr.z),this}setFromPoints(e){let t=this.getAttribute("position");if(t===void 0){let n=[];for(let s=0,r=e.length;s<r;s++){let o=e[s];n.push(o.x,o.y,o.z||0)}this.setAttribute("position",new Lt(n,3))}else{let n=Math.min(e.length,t.count);for(let s=0;s<n;s++){let r=e[s];t.setXYZ(s,r.x,r.y,r.z||0)}e.length>t.count&&tt("BufferGeometry: Buffer size too small for points data. Use .dispose() and create a new geometry."),t.needsUpdate=!0}return this}computeBoundingBox(){this.boundingBox===null&&(this.boundingBox=new Us);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){at("BufferGeometry.computeBoundingBox(): GLBufferAttribute requires a manual bounding box.",this),this.boundingBox.set(new X(-1/0,-1/0,-1/0),new X(1/0,1/0,1/0));return}if(e!==void 0){if(this.boundingBox.setFromBufferAttribute(e),t)for(let n=0,s=t.length;n<s;n++){let r=t[n];ri.setFromBufferAttribute(r),this.morphTargetsRelative?(Cn.addVectors(this.boundingBox.min,ri.min),this.boundingBox.expandByPoint(Cn),Cn.addVectors(this.boundingBox.max,ri.max),this.boundingBox.expandByPoint(Cn)):(this.boundingBox.expandByPoint(ri.min),this.boundingBox.expandByPoint(ri.max))}}else this.boundingBox.makeEmpty();(isNaN(this.boundingBox.min.x)||isNaN(this.boundingBox.min.y)||isNaN(this.boundingBox.min.z))&&at('BufferGeometry.computeBoundingBox(): Computed min/max have NaN values. The "position" attribute is likely to have NaN values.',this)}computeBoundingSphere(){this.boundingSphere===null&&(this.boundingSphere=new rr);let e=this.attributes.position,t=this.morphAttributes.position;if(e&&e.isGLBufferAttribute){at("BufferGeometry.computeBoundingSphere(): GLBufferAttribute requires a manual bounding sphere.",this),this.boundingSphere.set(new X,1/0);return}if(e){let n=this.boundingSphere.center;if(ri.setFromBufferAttribute(e),t)for(let r=0,o=t.length;r<o;r++){let a=t[r];Yo.setFromBufferAttribute(a),this.morphTargetsRelative?(Cn.addVectors(ri.min,Yo.min),ri.expandByPoint(Cn),Cn.addVectors(ri.max,Yo.max),ri.expandByPoint(Cn)):(ri.expandByPoint(Yo.min),ri.expandByPoint(Yo.max))}ri.getCenter(n);let s=0;for(let r=0,o=e.count;r<o;r++)Cn.fromBufferAttribute(e,r),s=Math.max(s,n.distanceToSquared(Cn));if(t)for(let r=0,o=t.length;r<o;r++){let a=t[r],l=this.morphTargetsRelative;for(let c=0,h=a.count;c<h;c++)Cn.fromBufferAttribute(a,c),l&&(Xr.fromBufferAttribute(e,c),Cn.add(Xr)),s=Math.max(s,n.distanceToSquared(Cn))}this.boundingSphere.radius=Math.sqrt(s),isNaN(this.boundingSphere.radius)&&at('BufferGeometry.computeBoundingSphere(): Computed radius is NaN. The "position" attribute is likely to have NaN values.',this)}}computeTangents(){let e=this.index,t=this.attributes;if(e===null||t.position===void 0||t.normal===void 0||t.uv===void 0){at("BufferGeometry: .computeTangents() failed. Missing required attributes (index, position, normal or uv)");return}let n=t.position,s=t.normal,r=t.uv,o=this.getAttribute("tangent");(o===void 0||o.count!==n.count)&&(o=new Un(new Float32Array(4*n.count),4),this.setAttribute("tangent",o));let a=[],l=[],c=new Uint8Array(n.count);for(let k=0;k<n.count;k++)a[k]=new X,l[k]=new X;let h=new X,d=new X,u=new X,f=new De,p=new De,x=new De,m=new X,g=new X;function S(k,N,I){c[k]=c[N]=c[I]=1,h.fromBufferAttribute(n,k),d.fromBufferAttribute(n,N),u.fromBufferAttribute(n,I),f.fromBufferAttribute(r,k),p.fromBufferAttribute(r,N),x.fromBufferAttribute(r,I),d.sub(h),u.sub(h),p.sub(f),x.sub(f);let G=1/(p.x*x.y-x.x*p.y);isFinite(G)&&(m.copy(d).multiplyScalar(x.y).addScaledVector(u,-p.y).multiplyScalar(G),g.copy(u).multiplyScalar(p.x).addScaledVector(d,-x.x).multiplyScalar(G),a[k].add(m),a[N].add(m),a[I].add(m),l[k].add(g),l[N].add(g),l[I].add(g))}let T=this.groups;T.length===0&&(T=[{start:0,count:e.count}]);for(let k=0,N=T.length;k<N;++k){let I=T[k],G=I.start,W=I.count;for(let L=G,H=G+W;L<H;L+=3)S(e.getX(L+0),e.getX(L+1),e.getX(L+2))}let y=new X,C=new X,A=new X,v=new X;function E(k){A.fromBufferAttribute(s,k),v.copy(A);let N=a[k];y.copy(N),y.sub(A.multiplyScalar(A.dot(N))).normalize(),C.crossVectors(v,N);let G=C.dot(l[k])<0?-1:1;o.setXYZW(k,y.x,y.y,y.z,G)}for(let k=0,N=n.count;k<N;++k)c[k]&&E(k);this._transformed=!0}computeVertexNormals(){let e=this.index,t=this.getAttribute("position");if(t!==void 0){let n=this.getAttribute("normal");if(n===void 0||n.count!==t.count)n=new Un(new Float32Array(t.count*3),3),this.setAttribute("normal",n);else for(let u=0,f=n.count;u<f;u++)n.setXYZ(u,0,0,0);let s=new X,r=new X,o=new X,a=new X,l=new X,c=new X,h=new X,d=new X;if(e)for(let u=0,f=e.count;u<f;u+=3){let p=e.getX(u+0),x=e.getX(u+1),m=e.getX(u+2);s.fromBufferAttribute(t,p),r.fromBufferAttribute(t,x),o.fromBufferAttribute(t,m),h.subVectors(o,r),d.subVectors(s,r),h.cross(d),a.fromBufferAttribute(n,p),l.fromBufferAttribute(n,x),c.fromBufferAttribute(n,m),a.add(h),l.add(h),c.add(h),n.setXYZ(p,a.x,a.y,a.z),n.setXYZ(x,l.x,l.y,l.z),n.setXYZ(m,c.x,c.y,c.z)}else for(let u=0,f=t.count;u<f;u+=3)s.fromBufferAttribute(t,u+0),r.fromBufferAttribute(t,u+1),o.fromBufferAttribute(t,u+2),h.subVectors(o,r),d.subVectors(s,r),h.cross(d),n.setXYZ(u+0,h.x,h.y,h.z),n.setXYZ(u+1,h.x,h.y,h.z),n.setXYZ(u+2,h.x,h.y,h.z);this.normalizeNormals(),n.needsUpdate=!0}}normalizeNormals(){let e=this.attributes.normal;for(let t=0,n=e.count;t<n;t++)Cn.fromBufferAttribute(e,t),Cn.normalize(),e.setXYZ(t,Cn.x,Cn.y,Cn.z)}toNonIndexed(){function e(a,l){let c=a.array,h=a.itemSize,d=a.normalized,u=new c.constructor(l.length*h),f=0,p=0;for(let x=0,m=l.length;x<m;x++){a.isInterleavedBufferAttribute?f=l[x]*a.data.stride+a.offset:f=l[x]*h;for(let g=0;g<h;g++)u[p++]=c[f++]}return new Un(u,h,d)}if(this.index===null)return tt("BufferGeometry.toNonIndexed(): BufferGeometry is already non-indexed."),this;let t=new i,n=this.index.array,s=this.attributes;for(let a in s){let l=s[a],c=e(l,n);t.setAttribute(a,c)}let r=this.morphAttributes;for(let a in r){let l=[],c=r[a];for(let h=0,d=c.length;h<d;h++){let u=c[h],f=e(u,n);l.push(f)}t.morphAttributes[a]=l}t.morphTargetsRelative=this.morphTargetsRelative;let o=this.groups;for(let a=0,l=o.length;a<l;a++){let c=o[a];t.addGroup(c.start,c.count,c.materialIndex)}return t}toJSON(){let e={metadata:{version:4.7,type:"BufferGeometry",generator:"BufferGeometry.toJSON"}};if(e.uuid=this.uuid,e.type=this.parameters!==void 0&&this._transformed===!0?"BufferGeometry":this.type,e.name=this.name,Object.keys(this.userData).length>0&&(e.userData=this.userData),this.parameters!==void 0&&this._transformed!==!0){let l=this.parameters;for(let c in l)l[c]!==void 0&&(e[c]=l[c]);return e}e.data={attributes:{}};let t=this.index;t!==null&&(e.data.index={type:t.array.constructor.name,array:Array.prototype.slice.call(t.array)});let n=this.attributes;for(let l in n){let c=n[l];e.data.attributes[l]=c.toJSON(e.data)}let s={},r=!1;for(let l in this.morphAttributes){let c=this.morphAttributes[l],h=[];for(let d=0,u=c.length;d<u;d++){let f=c[d];h.push(f.toJSON(e.data))}h.length>0&&(s[l]=h,r=!0)}r&&(e.data.morphAttributes=s,e.data.morphTargetsRelative=this.morphTargetsRelative);let o=this.groups;o.length>0&&(e.data.groups=JSON.parse(JSON.stringify(o)));let a=this.boundingSphere;return a!==null&&(e.data.boundingSphere=a.toJSON()),e}clone(){return new this.constructor().copy(this)}copy(e){this.index=null,this.attributes={},this.morphAttributes={},this.groups=[],this.boundingBox=null,this.boundingSphere=null;let t={};this.name=e.name;let n=e.index;n!==null&&this.setIndex(n.clone());let s=e.attributes;for(let c in s){let h=s[c];this.setAttribute(c,h.clone(t))}let r=e.morphAttributes;for(let c in r){let h=[],d=r[c];for(let u=0,f=d.length;u<f;u++)h.push(d[u].clone(t));this.morphAttributes[c]=h}this.morphTargetsRelative=e.morphTargetsRelative;let o=e.groups;for(let c=0,h=o.length;c<h;c++){let d=o[c];this.addGroup(d.start,d.count,d.materialIndex)}let a=e.boundingBox;a!==null&&(this.boundingBox=a.clone());let l=e.boundingSphere;return l!==null&&(this.boundingSphere=l.clone()),this.drawRange.start=e.drawRange.start,this.drawRange.count=e.drawRange.count,this.userData=e.userData,this._transformed=e._transformed,this}dispose(){this.dispatchEvent({type:"dispose"})}},ua=class{constructor(e,t){this.isInterleavedBuffer=!0,this.array=e,this.stride=t,this.count=e!==void 0?e.length/t:0,this.usage=Pd,this.updateRanges=[],this.version=0,this.uuid=Vs()}onUploadCallback(){}set needsUpdate(e){e===!0&&this.version++}setUsage(e){return this.usage=e,this}addUpdateRange(e,t){this.updateRanges.push({start:e,count:t})}clearUpdateRanges(){this.updateRanges.length=0}copy(e){return this.array=new e.array.constructor(e.array),this.count=e.count,this.stride=e.stride,this.usage=e.usage,this}copyAt(e,t,n){e*=this.stride,n*=t.stride;for(let s=0,r=this.stride;s<r;s++)this.array[e+s]=t.array[n+s];return this}set(e,t=0){return this.array.set(e,t),this}clone(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Dp(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=this.array.slice(0).buffer);let n=new this.array.constructor(e.arrayBuffers[t]),s=new this.constructor(n,this.stride);return s.setUsage(this.usage),s}onUpload(e){return this.onUploadCallback=e,this}toJSON(e){e.arrayBuffers===void 0&&(e.arrayBuffers={});let t=Dp(this.array);e.arrayBuffers[t]===void 0&&(e.arrayBuffers[t]=Array.from(new Uint32Array(this.array.slice(0).buffer)));let n={uuid:this.uuid,buffer:t,type:this.array.constructor.name,stride:this.stride};return n.usage=this.usage,n}};function Dp(i){return i.buffer._uuid===void 0&&(i.buffer._uuid=Vs()),i.byteOffset===0&&i.byteLength===i.buffer.byteLength?i.buffer._uuid:i.buffer._uuid+":"+i.byteOffset+":"+i.byteLength}var Yn=new X,ro=class i{constructor(e,t,n,s=!1){this.isInterleavedBufferAttribute=!0,this.name="",this.data=e,this.itemSize=t,this.offset=n,this.normalized=s,this._normalizationScale=e!==void 0?mh(e.array):void 0}get count(){return this.data.count}get array(){return this.data.array}set needsUpdate(e){this.data.needsUpdate=e}applyMatrix4(e){for(let t=0,n=this.data.count;t<n;t++)Yn.fromBufferAttribute(this,t),Yn.applyMatrix4(e),this.setXYZ(t,Yn.x,Yn.y,Yn.z);return this}applyNormalMatrix(e){for(let t=0,n=this.count;t<n;t++)Yn.fromBufferAttribute(this,t),Yn.applyNormalMatrix(e),this.setXYZ(t,Yn.x,Yn.y,Yn.z);return this}transformDirection(e){for(let t=0,n=this.count;t<n;t++)Yn.fromBufferAttribute(this,t),Yn.transformDirection(e),this.setXYZ(t,Yn.x,Yn.y,Yn.z);return this}getComponent(e,t){let n=this.array[e*this.data.stride+this.offset+t];return this.normalized&&(n=this._denormalize(n)),n}setComponent(e,t,n){return this.normalized&&(n=this._normalize(n)),this.data.array[e*this.data.stride+this.offset+t]=n,this}setX(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset]=t,this}setY(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+1]=t,this}setZ(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+2]=t,this}setW(e,t){return this.normalized&&(t=this._normalize(t)),this.data.array[e*this.data.stride+this.offset+3]=t,this}getX(e){let t=this.data.array[e*this.data.stride+this.offset];return this.normalized&&(t=this._denormalize(t)),t}getY(e){let t=this.data.array[e*this.data.stride+this.offset+1];return this.normalized&&(t=this._denormalize(t)),t}getZ(e){let t=this.data.array[e*this.data.stride+this.offset+2];return this.normalized&&(t=this._denormalize(t)),t}getW(e){let t=this.data.array[e*this.data.stride+this.offset+3];return this.normalized&&(t=this._denormalize(t)),t}setXY(e,t,n){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n)),this.data.array[e+0]=t,this.data.array[e+1]=n,this}setXYZ(e,t,n,s){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this}setXYZW(e,t,n,s,r){return e=e*this.data.stride+this.offset,this.normalized&&(t=this._normalize(t),n=this._normalize(n),s=this._normalize(s),r=this._normalize(r)),this.data.array[e+0]=t,this.data.array[e+1]=n,this.data.array[e+2]=s,this.data.array[e+3]=r,this}clone(e){if(e===void 0){oa("InterleavedBufferAttribute.clone(): Cloning an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return new Un(new this.array.constructor(t),this.itemSize,this.normalized)}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.clone(e)),new i(e.interleavedBuffers[this.data.uuid],this.itemSize,this.offset,this.normalized)}toJSON(e){if(e===void 0){oa("InterleavedBufferAttribute.toJSON(): Serializing an interleaved buffer attribute will de-interleave buffer data.");let t=[];for(let n=0;n<this.count;n++){let s=n*this.data.stride+this.offset;for(let r=0;r<this.itemSize;r++)t.push(this.data.array[s+r])}return{itemSize:this.itemSize,type:this.array.constructor.name,array:t,normalized:this.normalized}}else return e.interleavedBuffers===void 0&&(e.interleavedBuffers={}),e.interleavedBuffers[this.data.uuid]===void 0&&(e.interleavedBuffers[this.data.uuid]=this.data.toJSON(e)),{isInterleavedBufferAttribute:!0,itemSize:this.itemSize,data:this.data.uuid,offset:this.offset,normalized:this.normalized}}_denormalize(e){let t=this._normalizationScale;return t!==void 0?Math.max(e/t,-1):zm(e,this.data.array)}_normalize(e){let t=this._normalizationScale;return t!==void 0?Math.round(e*t):Hm(e,this.data.array)}},ku=new X,sv=new X,rv=new ft,Ti=class{constructor(e=new X(1,0,0),t=0){this.isPlane=!0,this.normal=e,this.constant=t}set(e,t){return this.normal.copy(e),this.constant=t,this}setComponents(e,t,n,s){return this.normal.set(e,t,n),this.constant=s,this}setFromNormalAndCoplanarPoint(e,t){return this.normal.copy(e),this.constant=-t.dot(this.normal),this}setFromCoplanarPoints(e,t,n){let s=ku.subVectors(n,t).cross(sv.subVectors(e,t)).normalize();return this.setFromNormalAndCoplanarPoint(s,e),this}copy(e){return this.normal.copy(e.normal),this.constant=e.constant,this}normalize(){let e=1/this.normal.length();return this.normal.multiplyScalar(e),this.constant*=e,this}negate(){return this.constant*=-1,this.normal.negate(),this}distanceToPoint(e){return this.normal.dot(e)+this.constant}distanceToSphere(e){return this.distanceToPoint(e.center)-e.radius}projectPoint(e,t){return t.copy(e).addScaledVector(this.normal,-this.distanceToPoint(e))}intersectLine(e,t,n=!0){let s=e.delta(ku),r=this.normal.dot(s);if(r===0)return this.distanceToPoint(e.start)===0?t.copy(e.start):null;let o=-(e.start.dot(this.normal)+this.constant)/r;return n===!0&&(o<0||o>1)?null:t.copy(e.start).addScaledVector(s,o)}intersectsLine(e){let t=this.distanceToPoint(e.start),n=this.distanceToPoint(e.end);return t<0&&n>0||n<0&&t>0}intersectsBox(e){return e.intersectsPlane(this)}intersectsSphere(e){return e.intersectsPlane(this)}coplanarPoint(e){return e.copy(this.normal).multiplyScalar(-this.constant)}applyMatrix4(e,t){let n=t||rv.getNormalMatrix(e),s=this.coplanarPoint(ku).applyMatrix4(e),r=this.normal.applyMatrix3(n).normalize();return this.constant=-s.dot(r),this}translate(e){return this.constant-=e.dot(this.normal),this}equals(e){return e.normal.equals(this.normal)&&e.constant===this.constant}clone(){return new this.constructor().copy(this)}toJSON(){return{normal:this.normal.toArray(),constant:this.constant}}fromJSON(e){return this.normal.fromArray(e.normal),this.constant=e.constant,this}},ov=0,Zi=class extends $i{constructor(){super(),this.isMaterial=!0,Object.defineProperty(this,"id",{value:ov++}),this.uuid=Vs(),this.name="",this.type="Material",this.blending=go,this.side=Hs,this.vertexColors=!1,this.opacity=1,this.transparent=!1,this.alphaHash=!1,this.blendSrc=hd,this.blendDst=ud,this.blendEquation=ur,this.blendSrcAlpha=null,this.blendDstAlpha=null,this.blendEquationAlpha=null,this.blendColor=new pt(0,0,0),this.blendAlpha=0,this.depthFunc=eo,this.depthTest=!0,this.depthWrite=!0,this.stencilWriteMask=255,this.stencilFunc=Cm,this.stencilRef=0,this.stencilFuncMask=255,this.stencilFail=zl,this.stencilZFail=zl,this.stencilZPass=zl,this.stencilWrite=!1,this.clippingPlanes=null,this.clipIntersection=!1,this.clipShadows=!1,this.shadowSide=null,this.colorWrite=!0,this.precision=null,this.polygonOffset=!1,this.polygonOffsetFactor=0,this.polygonOffsetUnits=0,this.dithering=!1,this.alphaToCoverage=!1,this.premultipliedAlpha=!1,this.forceSinglePass=!1,this.allowOverride=!0,this.visible=!0,this.toneMapped=!0,this.userData={},this.version=0,this._alphaTest=0}get alphaTest(){return this._alphaTest}set alphaTest(e){this._alphaTest>0!=e>0&&this.version++,this._alphaTest=e}onBeforeRender(){}onBeforeCompile(){}customProgramCacheKey(){return this.onBeforeCompile.toString()}setValues(e){if(e!==void 0)for(let t in e){let n=e[t];if(n===void 0){tt(`Material: parameter '${t}' has value of undefined.`);continue}let s=this[t];if(s===void 0){tt(`Material: '${t}' is not a property of THREE.${this.type}.`);continue}s&&s.isColor?s.set(n):s&&s.isVector2&&n&&n.isVector2||s&&s.isEuler&&n&&n.isEuler||s&&s.isVector3&&n&&n.isVector3?s.copy(n):this[t]=n}}toJSON(e){let t=e===void 0||typeof e=="string";t&&(e={textures:{},images:{}});let n={metadata:{version:4.7,type:"Material",generator:"Material.toJSON"}};n.uuid=this.uuid,n.type=this.type,n.blending=this.blending,n.side=this.side,n.shadowSide=this.shadowSide,n.vertexColors=this.vertexColors,n.opacity=this.opacity,n.transparent=this.transparent,n.blendSrc=this.blendSrc,n.blendDst=this.blendDst,n.blendEquation=this.blendEquation,n.blendSrcAlpha=this.blendSrcAlpha,n.blendDstAlpha=this.blendDstAlpha,n.blendEquationAlpha=this.blendEquationAlpha,n.blendColor=this.blendColor.getHex(),n.blendAlpha=this.blendAlpha,n.depthFunc=this.depthFunc,n.depthTest=this.depthTest,n.depthWrite=this.depthWrite,n.colorWrite=this.colorWrite,n.clipIntersection=this.clipIntersection,n.clipShadows=this.clipShadows,n.stencilWriteMask=this.stencilWriteMask,n.stencilFunc=this.stencilFunc,n.stencilRef=this.stencilRef,n.stencilFuncMask=this.stencilFuncMask,n.stencilFail=this.stencilFail,n.stencilZFail=this.stencilZFail,n.stencilZPass=this.stencilZPass,n.stencilWrite=this.stencilWrite,n.polygonOffset=this.polygonOffset,n.polygonOffsetFactor=this.polygonOffsetFactor,n.polygonOffsetUnits=this.polygonOffsetUnits,n.dithering=this.dithering,n.alphaTest=this.alphaTest,n.alphaHash=this.alphaHash,n.alphaToCoverage=this.alphaToCoverage,n.premultipliedAlpha=this.premultipliedAlpha,n.forceSinglePass=this.forceSinglePass,n.allowOverride=this.allowOverride,n.visible=this.visible,n.toneMapped=this.toneMapped,n.name=this.name,this.color&&this.color.isColor&&(n.color=this.color.getHex()),this.roughness!==void 0&&(n.roughness=this.roughness),this.metalness!==void 0&&(n.metalness=this.metalness),this.sheen!==void 0&&(n.sheen=this.sheen),this.sheenColor&&this.sheenColor.isColor&&(n.sheenColor=this.sheenColor.getHex()),this.sheenRoughness!==void 0&&(n.sheenRoughness=this.sheenRoughness),this.emissive&&this.emissive.isColor&&(n.emissive=this.emissive.getHex()),this.emissiveIntensity!==void 0&&(n.emissiveIntensity=this.emissiveIntensity),this.specular&&this.specular.isColor&&(n.specular=this.specular.getHex()),this.specularIntensity!==void 0&&(n.specularIntensity=this.specularIntensity),this.specularColor&&this.specularColor.isColor&&(n.specularColor=this.specularColor.getHex()),this.shininess!==void 0&&(n.shininess=this.shininess),this.clearcoat!==void 0&&(n.clearcoat=this.clearcoat),this.clearcoatRoughness!==void 0&&(n.clearcoatRoughness=this.clearcoatRoughness),this.diffuseRoughness!==void 0&&(n.diffuseRoughness=this.diffuseRoughness),this.diffuseRoughnessMap&&this.diffuseRoughnessMap.isTexture&&(n.diffuseRoughnessMap=this.diffuseRoughnessMap.toJSON(e).uuid),this.clearcoatMap&&this.clearcoatMap.isTexture&&(n.clearcoatMap=this.clearcoatMap.toJSON(e).uuid),this.clearcoatRoughnessMap&&this.clearcoatRoughnessMap.isTexture&&(n.clearcoatRoughnessMap=this.clearcoatRoughnessMap.toJSON(e).uuid),this.clearcoatNormalMap&&this.clearcoatNormalMap.isTexture&&(n.clearcoatNormalMap=this.clearcoatNormalMap.toJSON(e).uuid,n.clearcoatNormalScale=this.clearcoatNormalScale.toArray()),this.sheenColorMap&&this.sheenColorMap.isTexture&&(n.sheenColorMap=this.sheenColorMap.toJSON(e).uuid),this.sheenRoughnessMap&&this.sheenRoughnessMap.isTexture&&(n.sheenRoughnessMap=this.sheenRoughnessMap.toJSON(e).uuid),this.dispersion!==void 0&&(n.dispersion=this.dispersion),this.retroreflectivity!==void 0&&(n.retroreflectivity=this.retroreflectivity),this.iridescence!==void 0&&(n.iridescence=this.iridescence),this.iridescenceIOR!==void 0&&(n.iridescenceIOR=this.iridescenceIOR),this.iridescenceThicknessMinimum!==void 0&&(n.iridescenceThicknessMinimum=this.iridescenceThicknessMinimum),this.iridescenceThicknessMaximum!==void 0&&(n.iridescenceThicknessMaximum=this.iridescenceThicknessMaximum),this.iridescenceMap&&this.iridescenceMap.isTexture&&(n.iridescenceMap=this.iridescenceMap.toJSON(e).uuid),this.iridescenceThicknessMap&&this.iridescenceThicknessMap.isTexture&&(n.iridescenceThicknessMap=this.iridescenceThicknessMap.toJSON(e).uuid),this.anisotropy!==void 0&&(n.anisotropy=this.anisotropy),this.anisotropyRotation!==void 0&&(n.anisotropyRotation=this.anisotropyRotation),this.anisotropyMap&&this.anisotropyMap.isTexture&&(n.anisotropyMap=this.anisotropyMap.toJSON(e).uuid),this.map&&this.map.isTexture&&(n.map=this.map.toJSON(e).uuid),this.matcap&&this.matcap.isTexture&&(n.matcap=this.matcap.toJSON(e).uuid),this.alphaMap&&this.alphaMap.isTexture&&(n.alphaMap=this.alphaMap.toJSON(e).uuid),this.lightMap&&this.lightMap.isTexture&&(n.lightMap=this.lightMap.toJSON(e).uuid,n.lightMapIntensity=this.lightMapIntensity),this.aoMap&&this.aoMap.isTexture&&(n.aoMap=this.aoMap.toJSON(e).uuid,n.aoMapIntensity=this.aoMapIntensity),this.bumpMap&&this.bumpMap.isTexture&&(n.bumpMap=this.bumpMap.toJSON(e).uuid,n.bumpScale=this.bumpScale),this.normalMap&&this.normalMap.isTexture&&(n.normalMap=this.normalMap.toJSON(e).uuid,n.normalMapType=this.normalMapType,n.normalScale=this.normalScale.toArray()),this.displacementMap&&this.displacementMap.isTexture&&(n.displacementMap=this.displacementMap.toJSON(e).uuid,n.displacementScale=this.displacementScale,n.displacementBias=this.displacementBias),this.roughnessMap&&this.roughnessMap.isTexture&&(n.roughnessMap=this.roughnessMap.toJSON(e).uuid),this.metalnessMap&&this.metalnessMap.isTexture&&(n.metalnessMap=this.metalnessMap.toJSON(e).uuid),this.emissiveMap&&this.emissiveMap.isTexture&&(n.emissiveMap=this.emissiveMap.toJSON(e).uuid),this.specularMap&&this.specularMap.isTexture&&(n.specularMap=this.specularMap.toJSON(e).uuid),this.specularIntensityMap&&this.specularIntensityMap.isTexture&&(n.specularIntensityMap=this.specularIntensityMap.toJSON(e).uuid),this.specularColorMap&&this.specularColorMap.isTexture&&(n.specularColorMap=this.specularColorMap.toJSON(e).uuid),this.envMap&&this.envMap.isTexture&&(n.envMap=this.envMap.toJSON(e).uuid,this.combine!==void 0&&(n.combine=this.combine)),this.envMapRotation!==void 0&&(n.envMapRotation=this.envMapRotation.toArray()),this.envMapIntensity!==void 0&&(n.envMapIntensity=this.envMapIntensity),this.reflectivity!==void 0&&(n.reflectivity=this.reflectivity),this.refractionRatio!==void 0&&(n.refractionRatio=this.refractionRatio),this.gradientMap&&this.gradientMap.isTexture&&(n.gradientMap=this.gradientMap.toJSON(e).uuid),this.transmission!==void 0&&(n.transmission=this.transmission),this.transmissionMap&&this.transmissionMap.isTexture&&(n.transmissionMap=this.transmissionMap.toJSON(e).uuid),this.thickness!==void 0&&(n.thickness=this.thickness),this.thicknessMap&&this.thicknessMap.isTexture&&(n.thicknessMap=this.thicknessMap.toJSON(e).uuid),this.attenuationDistance!==void 0&&(n.attenuationDistance=this.attenuationDistance),this.attenuationColor!==void 0&&(n.attenuationColor=this.attenuationColor.getHex()),this.size!==void 0&&(n.size=this.size),this.sizeAttenuation!==void 0&&(n.sizeAttenuation=this.sizeAttenuation),Array.isArray(this.clippingPlanes)&&this.clippingPlanes.length>0&&(n.clippingPlanes=this.clippingPlanes.map(r=>r.toJSON())),this.rotation!==void 0&&(n.rotation=this.rotation),this.depthPacking!==void 0&&(n.depthPacking=this.depthPacking),this.linewidth!==void 0&&(n.linewidth=this.linewidth),this.linecap!==void 0&&(n.linecap=this.linecap),this.linejoin!==void 0&&(n.linejoin=this.linejoin),this.dashSize!==void 0&&(n.dashSize=this.dashSize),this.gapSize!==void 0&&(n.gapSize=this.gapSize),this.scale!==void 0&&(n.scale=this.scale),this.wireframe!==void 0&&(n.wireframe=this.wireframe),this.wireframeLinewidth!==void 0&&(n.wireframeLinewidth=this.wireframeLinewidth),this.wireframeLinecap!==void 0&&(n.wireframeLinecap=this.wireframeLinecap),this.wireframeLinejoin!==void 0&&(n.wireframeLinejoin=this.wireframeLinejoin),this.flatShading!==void 0&&(n.flatShading=this.flatShading),this.fog!==void 0&&(n.fog=this.fog),Object.keys(this.userData).length>0&&(n.userData=this.userData);function s(r){let o=[];for(let a in r){let l=r[a];delete l.metadata,o.push(l)}return o}if(t){let r=s(e.textures),o=s(e.images);r.length>0&&(n.textures=r),o.length>0&&(n.images=o)}return n}fromJSON(e,t){if(e.uuid!==void 0&&(this.uuid=e.uuid),e.name!==void 0&&(this.name=e.name),e.color!==void 0&&this.color!==void 0&&this.color.setHex(e.color),e.roughness!==void 0&&(this.roughness=e.roughness),e.metalness!==void 0&&(this.metalness=e.metalness),e.sheen!==void 0&&(this.sheen=e.sheen),e.sheenColor!==void 0&&(this.sheenColor=new pt().setHex(e.sheenColor)),e.sheenRoughness!==void 0&&(this.sheenRoughness=e.sheenRoughness),e.emissive!==void 0&&this.emissive!==void 0&&this.emissive.setHex(e.emissive),e.specular!==void 0&&this.specular!==void 0&&this.specular.setHex(e.specular),e.specularIntensity!==void 0&&(this.specularIntensity=e.specularIntensity),e.specularColor!==void 0&&this.specularColor!==void 0&&this.specularColor.setHex(e.specularColor),e.shininess!==void 0&&(this.shininess=e.shininess),e.clearcoat!==void 0&&(this.clearcoat=e.clearcoat),e.clearcoatRoughness!==void 0&&(this.clearcoatRoughness=e.clearcoatRoughness),e.diffuseRoughness!==void 0&&(this.diffuseRoughness=e.diffuseRoughness),e.dispersion!==void 0&&(this.dispersion=e.dispersion),e.retroreflectivity!==void 0&&(this.retroreflectivity=e.retroreflectivity),e.iridescence!==void 0&&(this.iridescence=e.iridescence),e.iridescenceIOR!==void 0&&(this.iridescenceIOR=e.iridescenceIOR),e.iridescenceThicknessMinimum!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessMinimum),e.iridescenceThicknessMaximum!==void 0&&(this.iridescenceThicknessMaximum=e.iridescenceThicknessMaximum),e.iridescenceThicknessRange!==void 0&&(this.iridescenceThicknessMinimum=e.iridescenceThicknessRange[0],this.iridescenceThicknessMaximum=e.iridescenceThicknessRange[1]),e.transmission!==void 0&&(this.transmission=e.transmission),e.thickness!==void 0&&(this.thickness=e.thickness),e.attenuationDistance!==void 0&&(this.attenuationDistance=e.attenuationDistance),e.attenuationColor!==void 0&&this.attenuationColor!==void 0&&this.attenuationColor.setHex(e.attenuationColor),e.anisotropy!==void 0&&(this.anisotropy=e.anisotropy),e.anisotropyRotation!==void 0&&(this.anisotropyRotation=e.anisotropyRotation),e.fog!==void 0&&(this.fog=e.fog),e.flatShading!==void 0&&(this.flatShading=e.flatShading),e.blending!==void 0&&(this.blending=e.blending),e.combine!==void 0&&(this.combine=e.combine),e.side!==void 0&&(this.side=e.side),e.shadowSide!==void 0&&(this.shadowSide=e.shadowSide),e.opacity!==void 0&&(this.opacity=e.opacity),e.transparent!==void 0&&(this.transparent=e.transparent),e.alphaTest!==void 0&&(this.alphaTest=e.alphaTest),e.alphaHash!==void 0&&(this.alphaHash=e.alphaHash),e.depthFunc!==void 0&&(this.depthFunc=e.depthFunc),e.depthTest!==void 0&&(this.depthTest=e.depthTest),e.depthWrite!==void 0&&(this.depthWrite=e.depthWrite),e.colorWrite!==void 0&&(this.colorWrite=e.colorWrite),e.clippingPlanes!==void 0&&(this.clippingPlanes=e.clippingPlanes.map(n=>new Ti().fromJSON(n))),e.clipIntersection!==void 0&&(this.clipIntersection=e.clipIntersection),e.clipShadows!==void 0&&(this.clipShadows=e.clipShadows),e.depthPacking!==void 0&&(this.depthPacking=e.depthPacking),e.blendSrc!==void 0&&(this.blendSrc=e.blendSrc),e.blendDst!==void 0&&(this.blendDst=e.blendDst),e.blendEquation!==void 0&&(this.blendEquation=e.blendEquation),e.blendSrcAlpha!==void 0&&(this.blendSrcAlpha=e.blendSrcAlpha),e.blendDstAlpha!==void 0&&(this.blendDstAlpha=e.blendDstAlpha),e.blendEquationAlpha!==void 0&&(this.blendEquationAlpha=e.blendEquationAlpha),e.blendColor!==void 0&&this.blendColor!==void 0&&this.blendColor.setHex(e.blendColor),e.blendAlpha!==void 0&&(this.blendAlpha=e.blendAlpha),e.stencilWriteMask!==void 0&&(this.stencilWriteMask=e.stencilWriteMask),e.stencilFunc!==void 0&&(this.stencilFunc=e.stencilFunc),e.stencilRef!==void 0&&(this.stencilRef=e.stencilRef),e.stencilFuncMask!==void 0&&(this.stencilFuncMask=e.stencilFuncMask),e.stencilFail!==void 0&&(this.stencilFail=e.stencilFail),e.stencilZFail!==void 0&&(this.stencilZFail=e.stencilZFail),e.stencilZPass!==void 0&&(this.stencilZPass=e.stencilZPass),e.stencilWrite!==void 0&&(this.stencilWrite=e.stencilWrite),e.wireframe!==void 0&&(this.wireframe=e.wireframe),e.wireframeLinewidth!==void 0&&(this.wireframeLinewidth=e.wireframeLinewidth),e.wireframeLinecap!==void 0&&(this.wireframeLinecap=e.wireframeLinecap),e.wireframeLinejoin!==void 0&&(this.wireframeLinejoin=e.wireframeLinejoin),e.rotation!==void 0&&(this.rotation=e.rotation),e.linewidth!==void 0&&(this.linewidth=e.linewidth),e.linecap!==void 0&&(this.linecap=e.linecap),e.linejoin!==void 0&&(this.linejoin=e.linejoin),e.dashSize!==void 0&&(this.dashSize=e.dashSize),e.gapSize!==void 0&&(this.gapSize=e.gapSize),e.scale!==void 0&&(this.scale=e.scale),e.polygonOffset!==void 0&&(this.polygonOffset=e.polygonOffset),e.polygonOffsetFactor!==void 0&&(this.polygonOffsetFactor=e.polygonOffsetFactor),e.polygonOffsetUnits!==void 0&&(this.polygonOffsetUnits=e.polygonOffsetUnits),e.dithering!==void 0&&(this.dithering=e.dithering),e.alphaToCoverage!==void 0&&(this.alphaToCoverage=e.alphaToCoverage),e.premultipliedAlpha!==void 0&&(this.premultipliedAlpha=e.premultipliedAlpha),e.forceSinglePass!==void 0&&(this.forceSinglePass=e.forceSinglePass),e.allowOverride!==void 0&&(this.allowOverride=e.allowOverride),e.visible!==void 0&&(this.visible=e.visible),e.toneMapped!==void 0&&(this.toneMapped=e.toneMapped),e.userData!==void 0&&(this.userData=e.userData),e.vertexColors!==void 0&&(typeof e.vertexColors=="number"?this.vertexColors=e.vertexColors>0:this.vertexColors=e.vertexColors),e.size!==void 0&&(this.size=e.size),e.sizeAttenuation!==void 0&&(this.sizeAttenuation=e.sizeAttenuation),e.map!==void 0&&(this.map=t[e.map]||null),e.matcap!==void 0&&(this.matcap=t[e.matcap]||null),e.alphaMap!==void 0&&(this.alphaMap=t[e.alphaMap]||null),e.bumpMap!==void 0&&(this.bumpMap=t[e.bumpMap]||null),e.bumpScale!==void 0&&(this.bumpScale=e.bumpScale),e.normalMap!==void 0&&(this.normalMap=t[e.normalMap]||null),e.normalMapType!==void 0&&(this.normalMapType=e.normalMapType),e.normalScale!==void 0){let n=e.normalScale;Array.isArray(n)===!1&&(n=[n,n]),this.normalScale=new De().fromArray(n)}return e.displacementMap!==void 0&&(this.displacementMap=t[e.displacementMap]||null),e.displacementScale!==void 0&&(this.displacementScale=e.displacementScale),e.displacementBias!==void 0&&(this.displacementBias=e.displacementBias),e.roughnessMap!==void 0&&(this.roughnessMap=t[e.roughnessMap]||null),e.metalnessMap!==void 0&&(this.metalnessMap=t[e.metalnessMap]||null),e.emissiveMap!==void 0&&(this.emissiveMap=t[e.emissiveMap]||null),e.emissiveIntensity!==void 0&&(this.emissiveIntensity=e.emissiveIntensity),e.specularMap!==void 0&&(this.specularMap=t[e.specularMap]||null),e.specularIntensityMap!==void 0&&(this.specularIntensityMap=t[e.specularIntensityMap]||null),e.specularColorMap!==void 0&&(this.specularColorMap=t[e.specularColorMap]||null),e.envMap!==void 0&&(this.envMap=t[e.envMap]||null),e.envMapRotation!==void 0&&this.envMapRotation.fromArray(e.envMapRotation),e.envMapIntensity!==void 0&&(this.envMapIntensity=e.envMapIntensity),e.reflectivity!==void 0&&(this.reflectivity=e.reflectivity),e.refractionRatio!==void 0&&(this.refractionRatio=e.refractionRatio),e.lightMap!==void 0&&(this.lightMap=t[e.lightMap]||null),e.lightMapIntensity!==void 0&&(this.lightMapIntensity=e.lightMapIntensity),e.aoMap!==void 0&&(this.aoMap=t[e.aoMap]||null),e.aoMapIntensity!==void 0&&(this.aoMapIntensity=e.aoMapIntensity),e.gradientMap!==void 0&&(this.gradientMap=t[e.gradientMap]||null),e.clearcoatMap!==void 0&&(this.clearcoatMap=t[e.clearcoatMap]||null),e.clearcoatRoughnessMap!==void 0&&(this.clearcoatRoughnessMap=t[e.clearcoatRoughnessMap]||null),e.clearcoatNormalMap!==void 0&&(this.clearcoatNormalMap=t[e.clearcoatNormalMap]||null),e.clearcoatNormalScale!==void 0&&(this.clearcoatNormalScale=new De().fromArray(e.clearcoatNormalScale)),e.diffuseRoughnessMap!==void 0&&(this.diffuseRoughnessMap=t[e.diffuseRoughnessMap]||null),e.iridescenceMap!==void 0&&(this.iridescenceMap=t[e.iridescenceMap]||null),e.iridescenceThicknessMap!==void 0&&(this.iridescenceThicknessMap=t[e.iridescenceThicknessMap]||null),e.transmissionMap!==void 0&&(this.transmissionMap=t[e.transmissionMap]||null),e.thicknessMap!==void 0&&(this.thicknessMap=t[e.thicknessMap]||null),e.anisotropyMap!==void 0&&(this.anisotropyMap=t[e.anisotropyMap]||null),e.sheenColorMap!==void 0&&(this.sheenColorMap=t[e.sheenColorMap]||null),e.sheenRoughnessMap!==void 0&&(this.sheenRoughnessMap=t[e.sheenRoughnessMap]||null),this}clone(){return new this.constructor().copy(this)}copy(e){this.name=e.name,this.blending=e.blending,this.side=e.side,this.vertexColors=e.vertexColors,this.opacity=e.opacity,this.transparent=e.transparent,this.blendSrc=e.blendSrc,this.blendDst=e.blendDst,this.blendEquation=e.blendEquation,this.blendSrcAlpha=e.blendSrcAlpha,this.blendDstAlpha=e.blendDstAlpha,this.blendEquationAlpha=e.blendEquationAlpha,this.blendColor.copy(e.blendColor),this.blendAlpha=e.blendAlpha,this.depthFunc=e.depthFunc,this.depthTest=e.depthTest,this.depthWrite=e.depthWrite,this.stencilWriteMask=e.stencilWriteMask,this.stencilFunc=e.stencilFunc,this.stencilRef=e.stencilRef,this.stencilFuncMask=e.stencilFuncMask,this.stencilFail=e.stencilFail,this.stencilZFail=e.stencilZFail,this.stencilZPass=e.stencilZPass,this.stencilWrite=e.stencilWrite;let t=e.clippingPlanes,n=null;if(t!==null){let s=t.length;n=new Array(s);for(let r=0;r!==s;++r)n[r]=t[r].clone()}return this.clippingPlanes=n,this.clipIntersection=e.clipIntersection,this.clipShadows=e.clipShadows,this.shadowSide=e.shadowSide,this.colorWrite=e.colorWrite,this.precision=e.precision,this.polygonOffset=e.polygonOffset,this.polygonOffsetFactor=e.polygonOffsetFactor,this.polygonOffsetUnits=e.polygonOffsetUnits,this.dithering=e.dithering,this.alphaTest=e.alphaTest,this.alphaHash=e.alphaHash,this.alphaToCoverage=e.alphaToCoverage,this.premultipliedAlpha=e.premultipliedAlpha,this.forceSinglePass=e.forceSinglePass,this.allowOverride=e.allowOverride,this.visible=e.visible,this.toneMapped=e.toneMapped,this.userData=JSON.parse(JSON.stringify(e.userData)),this}dispose(){this.dispatchEvent({type:"dispose"})}set needsUpdate(e){e===!0&&this.version++}},oo=class extends Zi{constructor(e){super(),this.isSpriteMaterial=!0,this.type="SpriteMaterial",this.color=new pt(16777215),this.map=null,this.alphaMap=null,this.rotation=0,this.sizeAttenuation=!0,this.transparent=!0,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.alphaMap=e.alphaMap,this.rotation=e.rotation,this.sizeAttenuation=e.sizeAttenuation,this.fog=e.fog,this}},qr,$o=new X,Yr=new X,$r=new X,Zr=new De,Zo=new De,Vm=new Ft,gl=new X,Jo=new X,_l=new X,Np=new De,zu=new De,Up=new De,da=class extends In{constructor(e=new oo){if(super(),this.isSprite=!0,this.type="Sprite",qr===void 0){qr=new Jt;let t=new Float32Array([-.5,-.5,0,0,0,.5,-.5,0,1,0,.5,.5,0,1,1,-.5,.5,0,0,1]),n=new ua(t,5);qr.setIndex([0,1,2,0,2,3]),qr.setAttribute("position",new ro(n,3,0,!1)),qr.setAttribute("uv",new ro(n,2,3,!1))}this.geometry=qr,this.material=e,this.center=new De(.5,.5),this.count=1}intersectsFrustum(e){return e.intersectsSprite(this)}raycast(e,t){e.camera===null&&at('Sprite: "Raycaster.camera" needs to be set in order to raycast against sprites.'),Yr.setFromMatrixScale(this.matrixWorld),Vm.copy(e.camera.matrixWorld),this.modelViewMatrix.multiplyMatrices(e.camera.matrixWorldInverse,this.matrixWorld),$r.setFromMatrixPosition(this.modelViewMatrix),e.camera.isPerspectiveCamera&&this.material.sizeAttenuation===!1&&Yr.multiplyScalar(-$r.z);let n=this.material.rotation,s,r;n!==0&&(r=Math.cos(n),s=Math.sin(n));let o=this.center;vl(gl.set(-.5,-.5,0),$r,o,Yr,s,r),vl(Jo.set(.5,-.5,0),$r,o,Yr,s,r),vl(_l.set(.5,.5,0),$r,o,Yr,s,r),Np.set(0,0),zu.set(1,0),Up.set(1,1);let a=e.ray.intersectTriangle(gl,Jo,_l,!1,$o);if(a===null&&(vl(Jo.set(-.5,.5,0),$r,o,Yr,s,r),zu.set(0,1),a=e.ray.intersectTriangle(gl,_l,Jo,!1,$o),a===null))return;let l=e.ray.origin.distanceTo($o);l<e.near||l>e.far||t.push({distance:l,point:$o.clone(),uv:Xi.getInterpolation($o,gl,Jo,_l,Np,zu,Up,new De),face:null,object:this})}copy(e,t){return super.copy(e,t),e.center!==void 0&&this.center.copy(e.center),this.material=e.material,this}toJSON(e){let t=super.toJSON(e);return t.object.center=this.center.toArray(),t}};function vl(i,e,t,n,s,r){Zr.subVectors(i,t).addScalar(.5).multiply(n),s!==void 0?(Zo.x=r*Zr.x-s*Zr.y,Zo.y=s*Zr.x+r*Zr.y):Zo.copy(Zr),i.copy(e),i.x+=Zo.x,i.y+=Zo.y,i.applyMatrix4(Vm)}var us=new X,Hu=new X,xl=new X,yl=new X,fa=class{constructor(e=new X,t=new X(0,0,-1)){this.origin=e,this.direction=t}set(e,t){return this.origin.copy(e),this.direction.copy(t),this}copy(e){return this.origin.copy(e.origin),this.direction.copy(e.direction),this}at(e,t){return t.copy(this.origin).addScaledVector(this.direction,e)}lookAt(e){return this.direction.copy(e).sub(this.origin).normalize(),this}recast(e){return this.origin.copy(this.at(e,us)),this}closestPointToPoint(e,t){t.subVectors(e,this.origin);let n=t.dot(this.direction);return n<0?t.copy(this.origin):t.copy(this.origin).addScaledVector(this.direction,n)}distanceToPoint(e){return Math.sqrt(this.distanceSqToPoint(e))}distanceSqToPoint(e){let t=us.subVectors(e,this.origin).dot(this.direction);return t<0?this.origin.distanceToSquared(e):(us.copy(this.origin).addScaledVector(this.direction,t),us.distanceToSquared(e))}distanceSqToSegment(e,t,n,s){Hu.copy(e).add(t).multiplyScalar(.5),xl.copy(t).sub(e).normalize(),yl.copy(this.origin).sub(Hu);let r=e.distanceTo(t)*.5,o=-this.direction.dot(xl),a=yl.dot(this.direction),l=-yl.dot(xl),c=yl.lengthSq(),h=Math.abs(1-o*o),d,u,f,p;if(h>0)if(d=o*l-a,u=o*a-l,p=r*h,d>=0)if(u>=-p)if(u<=p){let x=1/h;d*=x,u*=x,f=d*(d+o*u+2*a)+u*(o*d+u+2*l)+c}else u=r,d=Math.max(0,-(o*u+a)),f=-d*d+u*(u+2*l)+c;else u=-r,d=Math.max(0,-(o*u+a)),f=-d*d+u*(u+2*l)+c;else u<=-p?(d=Math.max(0,-(-o*r+a)),u=d>0?-r:Math.min(Math.max(-r,-l),r),f=-d*d+u*(u+2*l)+c):u<=p?(d=0,u=Math.min(Math.max(-r,-l),r),f=u*(u+2*l)+c):(d=Math.max(0,-(o*r+a)),u=d>0?r:Math.min(Math.max(-r,-l),r),f=-d*d+u*(u+2*l)+c);else u=o>0?-r:r,d=Math.max(0,-(o*u+a)),f=-d*d+u*(u+2*l)+c;return n&&n.copy(this.origin).addScaledVector(this.direction,d),s&&s.copy(Hu).addScaledVector(xl,u),f}intersectSphere(e,t){if(e.radius<0)return null;us.subVectors(e.center,this.origin);let n=us.dot(this.direction),s=us.dot(us)-n*n,r=e.radius*e.radius;if(s>r)return null;let o=Math.sqrt(r-s),a=n-o,l=n+o;return l<0?null:a<0?this.at(l,t):this.at(a,t)}intersectsSphere(e){return e.radius<0?!1:this.distanceSqToPoint(e.center)<=e.radius*e.radius}distanceToPlane(e){let t=e.normal.dot(this.direction);if(t===0)return e.distanceToPoint(this.origin)===0?0:null;let n=-(this.origin.dot(e.normal)+e.constant)/t;return n>=0?n:null}intersectPlane(e,t){let n=this.distanceToPlane(e);return n===null?null:this.at(n,t)}intersectsPlane(e){let t=e.distanceToPoint(this.origin);return t===0||e.normal.dot(this.direction)*t<0}intersectBox(e,t){let n,s,r,o,a,l,c=1/this.direction.x,h=1/this.direction.y,d=1/this.direction.z,u=this.origin;return c>=0?(n=(e.min.x-u.x)*c,s=(e.max.x-u.x)*c):(n=(e.max.x-u.x)*c,s=(e.min.x-u.x)*c),h>=0?(r=(e.min.y-u.y)*h,o=(e.max.y-u.y)*h):(r=(e.max.y-u.y)*h,o=(e.min.y-u.y)*h),n>o||r>s||((r>n||isNaN(n))&&(n=r),(o<s||isNaN(s))&&(s=o),d>=0?(a=(e.min.z-u.z)*d,l=(e.max.z-u.z)*d):(a=(e.max.z-u.z)*d,l=(e.min.z-u.z)*d),n>l||a>s)||((a>n||n!==n)&&(n=a),(l<s||s!==s)&&(s=l),s<0)?null:this.at(n>=0?n:s,t)}intersectsBox(e){return this.intersectBox(e,us)!==null}intersectTriangle(e,t,n,s,r){let o=this.origin,a=this.direction,l=a.x,c=a.y,h=a.z,d=e.x-o.x,u=e.y-o.y,f=e.z-o.z,p=t.x-o.x,x=t.y-o.y,m=t.z-o.z,g=n.x-o.x,S=n.y-o.y,T=n.z-o.z,y=Math.abs(l),C=Math.abs(c),A=Math.abs(h),v,E,k,N,I,G,W,L,H,Y,z,ce;if(y>=C&&y>=A?(k=l,G=d,H=p,ce=g,l>=0?(v=c,E=h,N=u,I=f,W=x,L=m,Y=S,z=T):(v=h,E=c,N=f,I=u,W=m,L=x,Y=T,z=S)):C>=A?(k=c,G=u,H=x,ce=S,c>=0?(v=h,E=l,N=f,I=d,W=m,L=p,Y=T,z=g):(v=l,E=h,N=d,I=f,W=p,L=m,Y=g,z=T)):(k=h,G=f,H=m,ce=T,h>=0?(v=l,E=c,N=d,I=u,W=p,L=x,Y=g,z=S):(v=c,E=l,N=u,I=d,W=x,L=p,Y=S,z=g)),k===0)return null;let J=v/k,j=E/k,te=1/k,fe=N-J*G,he=I-j*G,ee=W-J*H,ge=L-j*H,ve=Y-J*ce,Ie=z-j*ce,be=ve*ge-Ie*ee,Ge=fe*Ie-he*ve,st=ee*he-ge*fe;if(s){if(be<0||Ge<0||st<0)return null}else if((be<0||Ge<0||st<0)&&(be>0||Ge>0||st>0))return null;let Je=be+Ge+st;if(Je===0)return null;let rt=te*(be*G+Ge*H+st*ce);return(Je>0?rt<0:rt>0)?null:this.at(rt/Je,r)}applyMatrix4(e){return this.origin.applyMatrix4(e),this.direction.transformDirection(e),this}equals(e){return e.origin.equals(this.origin)&&e.direction.equals(this.direction)}clone(){return new this.constructor().copy(this)}},Ai=class extends Zi{constructor(e){super(),this.isMeshBasicMaterial=!0,this.type="MeshBasicMaterial",this.color=new pt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ps,this.combine=Rc,this.reflectivity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.fog=e.fog,this}},Fp=new Ft,tr=new fa,Sl=new rr,Op=new X,Ml=new X,bl=new X,wl=new X,Gu=new X,El=new X,Bp=new X,Tl=new X,kn=class extends In{constructor(e=new Jt,t=new Ai){super(),this.isMesh=!0,this.type="Mesh",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.count=1,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}getVertexPosition(e,t){let n=this.geometry,s=n.attributes.position,r=n.morphAttributes.position,o=n.morphTargetsRelative;t.fromBufferAttribute(s,e);let a=this.morphTargetInfluences;if(r&&a){El.set(0,0,0);for(let l=0,c=r.length;l<c;l++){let h=a[l],d=r[l];h!==0&&(Gu.fromBufferAttribute(d,e),o?El.addScaledVector(Gu,h):El.addScaledVector(Gu.sub(t),h))}t.add(El)}return t}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.material,r=this.matrixWorld;s!==void 0&&(n.boundingSphere===null&&n.computeBoundingSphere(),Sl.copy(n.boundingSphere),Sl.applyMatrix4(r),tr.copy(e.ray).recast(e.near),!(Sl.containsPoint(tr.origin)===!1&&(tr.intersectSphere(Sl,Op)===null||tr.origin.distanceToSquared(Op)>(e.far-e.near)**2))&&(Fp.copy(r).invert(),tr.copy(e.ray).applyMatrix4(Fp),!(n.boundingBox!==null&&tr.intersectsBox(n.boundingBox)===!1)&&this._computeIntersections(e,t,tr)))}_computeIntersections(e,t,n){let s,r=this.geometry,o=this.material,a=r.index,l=r.attributes.position,c=r.attributes.uv,h=r.attributes.uv1,d=r.attributes.normal,u=r.groups,f=r.drawRange;if(a!==null)if(Array.isArray(o))for(let p=0,x=u.length;p<x;p++){let m=u[p],g=o[m.materialIndex],S=Math.max(m.start,f.start),T=Math.min(a.count,Math.min(m.start+m.count,f.start+f.count));for(let y=S,C=T;y<C;y+=3){let A=a.getX(y),v=a.getX(y+1),E=a.getX(y+2);s=Al(this,g,e,n,c,h,d,A,v,E),s&&(s.faceIndex=Math.floor(y/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),x=Math.min(a.count,f.start+f.count);for(let m=p,g=x;m<g;m+=3){let S=a.getX(m),T=a.getX(m+1),y=a.getX(m+2);s=Al(this,o,e,n,c,h,d,S,T,y),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}else if(l!==void 0)if(Array.isArray(o))for(let p=0,x=u.length;p<x;p++){let m=u[p],g=o[m.materialIndex],S=Math.max(m.start,f.start),T=Math.min(l.count,Math.min(m.start+m.count,f.start+f.count));for(let y=S,C=T;y<C;y+=3){let A=y,v=y+1,E=y+2;s=Al(this,g,e,n,c,h,d,A,v,E),s&&(s.faceIndex=Math.floor(y/3),s.face.materialIndex=m.materialIndex,t.push(s))}}else{let p=Math.max(0,f.start),x=Math.min(l.count,f.start+f.count);for(let m=p,g=x;m<g;m+=3){let S=m,T=m+1,y=m+2;s=Al(this,o,e,n,c,h,d,S,T,y),s&&(s.faceIndex=Math.floor(m/3),t.push(s))}}}};function av(i,e,t,n,s,r,o,a){let l;if(e.side===Kn?l=n.intersectTriangle(o,r,s,!0,a):l=n.intersectTriangle(s,r,o,e.side===Hs,a),l===null)return null;Tl.copy(a),Tl.applyMatrix4(i.matrixWorld);let c=t.ray.origin.distanceTo(Tl);return c<t.near||c>t.far?null:{distance:c,point:Tl.clone(),object:i}}function Al(i,e,t,n,s,r,o,a,l,c){i.getVertexPosition(a,Ml),i.getVertexPosition(l,bl),i.getVertexPosition(c,wl);let h=av(i,e,t,n,Ml,bl,wl,Bp);if(h){let d=new X;Xi.getBarycoord(Bp,Ml,bl,wl,d),s&&(h.uv=Xi.getInterpolatedAttribute(s,a,l,c,d,new De)),r&&(h.uv1=Xi.getInterpolatedAttribute(r,a,l,c,d,new De)),o&&(h.normal=Xi.getInterpolatedAttribute(o,a,l,c,d,new X),h.normal.dot(n.direction)>0&&h.normal.multiplyScalar(-1));let u={a,b:l,c,normal:new X,materialIndex:0};Xi.getNormal(Ml,bl,wl,u.normal),h.face=u,h.barycoord=d}return h}var nc=class extends Jn{constructor(e=null,t=1,n=1,s,r,o,a,l,c=Pn,h=Pn,d,u){super(null,o,a,l,c,h,s,r,d,u),this.isDataTexture=!0,this.image={data:e,width:t,height:n},this.generateMipmaps=!1,this.flipY=!1,this.unpackAlignment=1}};var nr=new rr,lv=new De(.5,.5),Rl=new X,Fs=class{constructor(e=new Ti,t=new Ti,n=new Ti,s=new Ti,r=new Ti,o=new Ti){this.planes=[e,t,n,s,r,o]}set(e,t,n,s,r,o){let a=this.planes;return a[0].copy(e),a[1].copy(t),a[2].copy(n),a[3].copy(s),a[4].copy(r),a[5].copy(o),this}copy(e){let t=this.planes;for(let n=0;n<6;n++)t[n].copy(e.planes[n]);return this}setFromProjectionMatrix(e,t=gi,n=!1){let s=this.planes,r=e.elements,o=r[0],a=r[1],l=r[2],c=r[3],h=r[4],d=r[5],u=r[6],f=r[7],p=r[8],x=r[9],m=r[10],g=r[11],S=r[12],T=r[13],y=r[14],C=r[15];if(s[0].setComponents(c-o,f-h,g-p,C-S).normalize(),s[1].setComponents(c+o,f+h,g+p,C+S).normalize(),s[2].setComponents(c+a,f+d,g+x,C+T).normalize(),s[3].setComponents(c-a,f-d,g-x,C-T).normalize(),n)s[4].setComponents(l,u,m,y).normalize(),s[5].setComponents(c-l,f-u,g-m,C-y).normalize();else if(s[4].setComponents(c-l,f-u,g-m,C-y).normalize(),t===gi)s[5].setComponents(c+l,f+u,g+m,C+y).normalize();else if(t===to)s[5].setComponents(l,u,m,y).normalize();else throw new Error("THREE.Frustum.setFromProjectionMatrix(): Invalid coordinate system: "+t);return this}intersectsObject(e){if(e.boundingSphere!==void 0)e.boundingSphere===null&&e.computeBoundingSphere(),nr.copy(e.boundingSphere).applyMatrix4(e.matrixWorld);else{let t=e.geometry;t.boundingSphere===null&&t.computeBoundingSphere(),nr.copy(t.boundingSphere).applyMatrix4(e.matrixWorld)}return this.intersectsSphere(nr)}intersectsSprite(e){nr.center.set(0,0,0);let t=lv.distanceTo(e.center);return nr.radius=.7071067811865476+t,nr.applyMatrix4(e.matrixWorld),this.intersectsSphere(nr)}intersectsSphere(e){let t=this.planes,n=e.center,s=-e.radius;for(let r=0;r<6;r++)if(t[r].distanceToPoint(n)<s)return!1;return!0}intersectsBox(e){let t=this.planes;for(let n=0;n<6;n++){let s=t[n];if(Rl.x=s.normal.x>0?e.max.x:e.min.x,Rl.y=s.normal.y>0?e.max.y:e.min.y,Rl.z=s.normal.z>0?e.max.z:e.min.z,s.distanceToPoint(Rl)<0)return!1}return!0}containsPoint(e){let t=this.planes;for(let n=0;n<6;n++)if(t[n].distanceToPoint(e)<0)return!1;return!0}clone(){return new this.constructor().copy(this)}},kp=new Ft,ic=class i{constructor(){this.coordinateSystem=gi,this._frustums=[],this._count=0}setFromArrayCamera(e){let t=e.cameras,n=this._frustums;for(let s=0;s<t.length;s++){let r=t[s];kp.multiplyMatrices(r.projectionMatrix,r.matrixWorldInverse),n[s]===void 0&&(n[s]=new Fs),n[s].setFromProjectionMatrix(kp,r.coordinateSystem,r.reversedDepth)}return this._count=t.length,this}getFrustum(e){return this._frustums[e]}intersectsObject(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsObject(e))return!0;return!1}intersectsSprite(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSprite(e))return!0;return!1}intersectsSphere(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsSphere(e))return!0;return!1}intersectsBox(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].intersectsBox(e))return!0;return!1}containsPoint(e){let t=this._frustums;for(let n=0;n<this._count;n++)if(t[n].containsPoint(e))return!0;return!1}copy(e){this.coordinateSystem=e.coordinateSystem;let t=this._frustums,n=e._frustums;for(let s=0;s<e._count;s++)t[s]===void 0&&(t[s]=new Fs),t[s].copy(n[s]);return this._count=e._count,this}clone(){return new i().copy(this)}};var Ri=class extends Zi{constructor(e){super(),this.isLineBasicMaterial=!0,this.type="LineBasicMaterial",this.color=new pt(16777215),this.map=null,this.linewidth=1,this.linecap="round",this.linejoin="round",this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.linewidth=e.linewidth,this.linecap=e.linecap,this.linejoin=e.linejoin,this.fog=e.fog,this}},sc=new X,rc=new X,zp=new Ft,Ko=new fa,Cl=new rr,Vu=new X,Hp=new X,ao=class extends In{constructor(e=new Jt,t=new Ri){super(),this.isLine=!0,this.type="Line",this.geometry=e,this.material=t,this.morphTargetDictionary=void 0,this.morphTargetInfluences=void 0,this.updateMorphTargets()}copy(e,t){return super.copy(e,t),e.morphTargetInfluences!==void 0?this.morphTargetInfluences=e.morphTargetInfluences.slice():this.morphTargetInfluences=void 0,e.morphTargetDictionary!==void 0?this.morphTargetDictionary=Object.assign({},e.morphTargetDictionary):this.morphTargetDictionary=void 0,this.material=Array.isArray(e.material)?e.material.slice():e.material,this.geometry=e.geometry,this}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[0];for(let s=1,r=t.count;s<r;s++)sc.fromBufferAttribute(t,s-1),rc.fromBufferAttribute(t,s),n[s]=n[s-1],n[s]+=sc.distanceTo(rc);e.setAttribute("lineDistance",new Lt(n,1))}else tt("Line.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}intersectsFrustum(e){return e.intersectsObject(this)}raycast(e,t){let n=this.geometry,s=this.matrixWorld,r=e.params.Line.threshold,o=n.drawRange;if(n.boundingSphere===null&&n.computeBoundingSphere(),Cl.copy(n.boundingSphere),Cl.applyMatrix4(s),Cl.radius+=r,e.ray.intersectsSphere(Cl)===!1)return;zp.copy(s).invert(),Ko.copy(e.ray).applyMatrix4(zp);let a=r/((this.scale.x+this.scale.y+this.scale.z)/3),l=a*a,c=this.isLineSegments?2:1,h=n.index,u=n.attributes.position;if(h!==null){let f=Math.max(0,o.start),p=Math.min(h.count,o.start+o.count);for(let x=f,m=p-1;x<m;x+=c){let g=h.getX(x),S=h.getX(x+1),T=Pl(this,e,Ko,l,g,S,x);T&&t.push(T)}if(this.isLineLoop){let x=h.getX(p-1),m=h.getX(f),g=Pl(this,e,Ko,l,x,m,p-1);g&&t.push(g)}}else{let f=Math.max(0,o.start),p=Math.min(u.count,o.start+o.count);for(let x=f,m=p-1;x<m;x+=c){let g=Pl(this,e,Ko,l,x,x+1,x);g&&t.push(g)}if(this.isLineLoop){let x=Pl(this,e,Ko,l,p-1,f,p-1);x&&t.push(x)}}}updateMorphTargets(){let t=this.geometry.morphAttributes,n=Object.keys(t);if(n.length>0){let s=t[n[0]];if(s!==void 0){this.morphTargetInfluences=[],this.morphTargetDictionary={};for(let r=0,o=s.length;r<o;r++){let a=s[r].name||String(r);this.morphTargetInfluences.push(0),this.morphTargetDictionary[a]=r}}}}};function Pl(i,e,t,n,s,r,o){let a=i.geometry.attributes.position;if(sc.fromBufferAttribute(a,s),rc.fromBufferAttribute(a,r),t.distanceSqToSegment(sc,rc,Vu,Hp)>n)return;Vu.applyMatrix4(i.matrixWorld);let c=e.ray.origin.distanceTo(Vu);if(!(c<e.near||c>e.far))return{distance:c,point:Hp.clone().applyMatrix4(i.matrixWorld),index:o,face:null,faceIndex:null,barycoord:null,object:i}}var Gp=new X,Vp=new X,ms=class extends ao{constructor(e,t){super(e,t),this.isLineSegments=!0,this.type="LineSegments"}computeLineDistances(){let e=this.geometry;if(e.index===null){let t=e.attributes.position,n=[];for(let s=0,r=t.count;s<r;s+=2)Gp.fromBufferAttribute(t,s),Vp.fromBufferAttribute(t,s+1),n[s]=s===0?0:n[s-1],n[s+1]=n[s]+Gp.distanceTo(Vp);e.setAttribute("lineDistance",new Lt(n,1))}else tt("LineSegments.computeLineDistances(): Computation only possible with non-indexed BufferGeometry.");return this}};var pa=class extends Jn{constructor(e=[],t=dr,n,s,r,o,a,l,c,h){super(e,t,n,s,r,o,a,l,c,h),this.isCubeTexture=!0,this.flipY=!1}get images(){return this.image}set images(e){this.image=e}},ma=class extends Jn{constructor(e,t,n,s,r,o,a,l,c){super(e,t,n,s,r,o,a,l,c),this.isCanvasTexture=!0,this.needsUpdate=!0}};var gs=class extends Jn{constructor(e,t,n=Ci,s,r,o,a=Pn,l=Pn,c,h=fs,d=1){if(h!==fs&&h!==vs)throw new Error("THREE.DepthTexture: format must be either THREE.DepthFormat or THREE.DepthStencilFormat");let u={width:e,height:t,depth:d};super(u,s,r,o,a,l,h,n,c),this.isDepthTexture=!0,this.flipY=!1,this.generateMipmaps=!1,this.compareFunction=null}copy(e){return super.copy(e),this.source=new io(Object.assign({},e.image)),this.compareFunction=e.compareFunction,this}toJSON(e){let t=super.toJSON(e);return t.compareFunction=this.compareFunction,t}},ga=class extends gs{constructor(e,t=Ci,n=dr,s,r,o=Pn,a=Pn,l,c=fs){let h={width:e,height:e,depth:1},d=[h,h,h,h,h,h];super(e,e,t,n,s,r,o,a,l,c),this.image=d,this.isCubeDepthTexture=!0,this.isCubeTexture=!0}get images(){return this.image}set images(e){this.image=e}},_a=class extends Jn{constructor(e=null){super(),this.sourceTexture=e,this.isExternalTexture=!0}copy(e){return super.copy(e),this.sourceTexture=e.sourceTexture,this}},Os=class i extends Jt{constructor(e=1,t=1,n=1,s=1,r=1,o=1){super(),this.type="BoxGeometry",this.parameters={width:e,height:t,depth:n,widthSegments:s,heightSegments:r,depthSegments:o};let a=this;s=Math.floor(s),r=Math.floor(r),o=Math.floor(o);let l=[],c=[],h=[],d=[],u=0,f=0;p("z","y","x",-1,-1,n,t,e,o,r,0),p("z","y","x",1,-1,n,t,-e,o,r,1),p("x","z","y",1,1,e,n,t,s,o,2),p("x","z","y",1,-1,e,n,-t,s,o,3),p("x","y","z",1,-1,e,t,n,s,r,4),p("x","y","z",-1,-1,e,t,-n,s,r,5),this.setIndex(l),this.setAttribute("position",new Lt(c,3)),this.setAttribute("normal",new Lt(h,3)),this.setAttribute("uv",new Lt(d,2));function p(x,m,g,S,T,y,C,A,v,E,k){let N=y/v,I=C/E,G=y/2,W=C/2,L=A/2,H=v+1,Y=E+1,z=0,ce=0,J=new X;for(let j=0;j<Y;j++){let te=j*I-W;for(let fe=0;fe<H;fe++){let he=fe*N-G;J[x]=he*S,J[m]=te*T,J[g]=L,c.push(J.x,J.y,J.z),J[x]=0,J[m]=0,J[g]=A>0?1:-1,h.push(J.x,J.y,J.z),d.push(fe/v),d.push(1-j/E),z+=1}}for(let j=0;j<E;j++)for(let te=0;te<v;te++){let fe=u+te+H*j,he=u+te+H*(j+1),ee=u+(te+1)+H*(j+1),ge=u+(te+1)+H*j;l.push(fe,he,ge),l.push(he,ee,ge),ce+=6}a.addGroup(f,ce,k),f+=ce,u+=z}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.depth,e.widthSegments,e.heightSegments,e.depthSegments)}};var lo=class i extends Jt{constructor(e=1,t=1,n=1,s=32,r=1,o=!1,a=0,l=Math.PI*2){super(),this.type="CylinderGeometry",this.parameters={radiusTop:e,radiusBottom:t,height:n,radialSegments:s,heightSegments:r,openEnded:o,thetaStart:a,thetaLength:l};let c=this;s=Math.floor(s),r=Math.floor(r);let h=[],d=[],u=[],f=[],p=0,x=[],m=n/2,g=0;S(),o===!1&&(e>0&&T(!0),t>0&&T(!1)),this.setIndex(h),this.setAttribute("position",new Lt(d,3)),this.setAttribute("normal",new Lt(u,3)),this.setAttribute("uv",new Lt(f,2));function S(){let y=new X,C=new X,A=0,v=(t-e)/n;for(let E=0;E<=r;E++){let k=[],N=E/r,I=N*(t-e)+e;for(let G=0;G<=s;G++){let W=G/s,L=W*l+a,H=Math.sin(L),Y=Math.cos(L);C.x=I*H,C.y=-N*n+m,C.z=I*Y,d.push(C.x,C.y,C.z),y.set(H,v,Y).normalize(),u.push(y.x,y.y,y.z),f.push(W,1-N),k.push(p++)}x.push(k)}for(let E=0;E<s;E++)for(let k=0;k<r;k++){let N=x[k][E],I=x[k+1][E],G=x[k+1][E+1],W=x[k][E+1];(e>0||k!==0)&&(h.push(N,I,W),A+=3),(t>0||k!==r-1)&&(h.push(I,G,W),A+=3)}c.addGroup(g,A,0),g+=A}function T(y){let C=p,A=new De,v=new X,E=0,k=y===!0?e:t,N=y===!0?1:-1;for(let G=1;G<=s;G++)d.push(0,m*N,0),u.push(0,N,0),f.push(.5,.5),p++;let I=p;for(let G=0;G<=s;G++){let L=G/s*l+a,H=Math.cos(L),Y=Math.sin(L);v.x=k*Y,v.y=m*N,v.z=k*H,d.push(v.x,v.y,v.z),u.push(0,N,0),A.x=H*.5+.5,A.y=Y*.5*N+.5,f.push(A.x,A.y),p++}for(let G=0;G<s;G++){let W=C+G,L=I+G;y===!0?h.push(L,L+1,W):h.push(L+1,L,W),E+=3}c.addGroup(g,E,y===!0?1:2),g+=E}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.radiusTop,e.radiusBottom,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}},co=class i extends lo{constructor(e=1,t=1,n=32,s=1,r=!1,o=0,a=Math.PI*2){super(0,e,t,n,s,r,o,a),this.type="ConeGeometry",this.parameters={radius:e,height:t,radialSegments:n,heightSegments:s,openEnded:r,thetaStart:o,thetaLength:a}}static fromJSON(e){return new i(e.radius,e.height,e.radialSegments,e.heightSegments,e.openEnded,e.thetaStart,e.thetaLength)}};var Il=new X,Ll=new X,Wu=new X,Dl=new Xi,va=class extends Jt{constructor(e=null,t=1){if(super(),this.type="EdgesGeometry",this.parameters={geometry:e,thresholdAngle:t},e!==null){let s=Math.pow(10,4),r=Math.cos(Hl*t),o=e.getIndex(),a=e.getAttribute("position"),l=o?o.count:a.count,c=[0,0,0],h=["a","b","c"],d=new Array(3),u=new Map,f=[];for(let p=0;p<l;p+=3){o?(c[0]=o.getX(p),c[1]=o.getX(p+1),c[2]=o.getX(p+2)):(c[0]=p,c[1]=p+1,c[2]=p+2);let{a:x,b:m,c:g}=Dl;if(x.fromBufferAttribute(a,c[0]),m.fromBufferAttribute(a,c[1]),g.fromBufferAttribute(a,c[2]),Dl.getNormal(Wu),d[0]=`${Math.round(x.x*s)},${Math.round(x.y*s)},${Math.round(x.z*s)}`,d[1]=`${Math.round(m.x*s)},${Math.round(m.y*s)},${Math.round(m.z*s)}`,d[2]=`${Math.round(g.x*s)},${Math.round(g.y*s)},${Math.round(g.z*s)}`,!(d[0]===d[1]||d[1]===d[2]||d[2]===d[0]))for(let S=0;S<3;S++){let T=(S+1)%3,y=d[S],C=d[T],A=Dl[h[S]],v=Dl[h[T]],E=`${y}_${C}`,k=`${C}_${y}`,N=u.get(k);N?(Wu.dot(N.normal)<=r&&(f.push(A.x,A.y,A.z),f.push(v.x,v.y,v.z)),u.set(k,null)):u.has(E)||u.set(E,{index0:c[S],index1:c[T],normal:Wu.clone()})}}for(let p of u.values())if(p){let{index0:x,index1:m}=p;Il.fromBufferAttribute(a,x),Ll.fromBufferAttribute(a,m),f.push(Il.x,Il.y,Il.z),f.push(Ll.x,Ll.y,Ll.z)}this.setAttribute("position",new Lt(f,3))}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}},ai=class{constructor(){this.type="Curve",this.arcLengthDivisions=200,this.needsUpdate=!1,this.cacheArcLengths=null}getPoint(){tt("Curve: .getPoint() not implemented.")}getPointAt(e,t){let n=this.getUtoTmapping(e);return this.getPoint(n,t)}getPoints(e=5){let t=[];for(let n=0;n<=e;n++)t.push(this.getPoint(n/e));return t}getSpacedPoints(e=5){let t=[];for(let n=0;n<=e;n++)t.push(this.getPointAt(n/e));return t}getLength(){let e=this.getLengths();return e[e.length-1]}getLengths(e=this.arcLengthDivisions){if(this.cacheArcLengths&&this.cacheArcLengths.length===e+1&&!this.needsUpdate)return this.cacheArcLengths;this.needsUpdate=!1;let t=[],n,s=this.getPoint(0),r=0;t.push(0);for(let o=1;o<=e;o++)n=this.getPoint(o/e),r+=n.distanceTo(s),t.push(r),s=n;return this.cacheArcLengths=t,t}updateArcLengths(){this.needsUpdate=!0,this.getLengths()}getUtoTmapping(e,t=null){let n=this.getLengths(),s=0,r=n.length,o;t?o=t:o=e*n[r-1];let a=0,l=r-1,c;for(;a<=l;)if(s=Math.floor(a+(l-a)/2),c=n[s]-o,c<0)a=s+1;else if(c>0)l=s-1;else{l=s;break}if(s=l,n[s]===o)return s/(r-1);let h=n[s],u=n[s+1]-h,f=(o-h)/u;return(s+f)/(r-1)}getTangent(e,t){let s=e-1e-4,r=e+1e-4;s<0&&(s=0),r>1&&(r=1);let o=this.getPoint(s),a=this.getPoint(r),l=t||(o.isVector2?new De:new X);return l.copy(a).sub(o).normalize(),l}getTangentAt(e,t){let n=this.getUtoTmapping(e);return this.getTangent(n,t)}computeFrenetFrames(e,t=!1){let n=new X,s=[],r=[],o=[],a=new X,l=new Ft;for(let f=0;f<=e;f++){let p=f/e;s[f]=this.getTangentAt(p,new X)}r[0]=new X,o[0]=new X;let c=Number.MAX_VALUE,h=Math.abs(s[0].x),d=Math.abs(s[0].y),u=Math.abs(s[0].z);h<=c&&(c=h,n.set(1,0,0)),d<=c&&(c=d,n.set(0,1,0)),u<=c&&n.set(0,0,1),a.crossVectors(s[0],n).normalize(),r[0].crossVectors(s[0],a),o[0].crossVectors(s[0],r[0]);for(let f=1;f<=e;f++){if(r[f]=r[f-1].clone(),o[f]=o[f-1].clone(),a.crossVectors(s[f-1],s[f]),a.length()>Number.EPSILON){a.normalize();let p=Math.acos(wt(s[f-1].dot(s[f]),-1,1));r[f].applyMatrix4(l.makeRotationAxis(a,p))}o[f].crossVectors(s[f],r[f])}if(t===!0){let f=Math.acos(wt(r[0].dot(r[e]),-1,1));f/=e,s[0].dot(a.crossVectors(r[0],r[e]))>0&&(f=-f);for(let p=1;p<=e;p++)r[p].applyMatrix4(l.makeRotationAxis(s[p],f*p)),o[p].crossVectors(s[p],r[p])}return{tangents:s,normals:r,binormals:o}}clone(){return new this.constructor().copy(this)}copy(e){return this.arcLengthDivisions=e.arcLengthDivisions,this.cacheArcLengths=null,this}toJSON(){let e={metadata:{version:4.7,type:"Curve",generator:"Curve.toJSON"}};return e.arcLengthDivisions=this.arcLengthDivisions,e.type=this.type,e}fromJSON(e){return this.arcLengthDivisions=e.arcLengthDivisions,this.cacheArcLengths=null,this}},ho=class extends ai{constructor(e=0,t=0,n=1,s=1,r=0,o=Math.PI*2,a=!1,l=0){super(),this.isEllipseCurve=!0,this.type="EllipseCurve",this.aX=e,this.aY=t,this.xRadius=n,this.yRadius=s,this.aStartAngle=r,this.aEndAngle=o,this.aClockwise=a,this.aRotation=l}getPoint(e,t=new De){let n=t,s=Math.PI*2,r=this.aEndAngle-this.aStartAngle,o=Math.abs(r)<Number.EPSILON;for(;r<0;)r+=s;for(;r>s;)r-=s;r<Number.EPSILON&&(o?r=0:r=s),this.aClockwise===!0&&!o&&(r===s?r=-s:r=r-s);let a=this.aStartAngle+e*r,l=this.aX+this.xRadius*Math.cos(a),c=this.aY+this.yRadius*Math.sin(a);if(this.aRotation!==0){let h=Math.cos(this.aRotation),d=Math.sin(this.aRotation),u=l-this.aX,f=c-this.aY;l=u*h-f*d+this.aX,c=u*d+f*h+this.aY}return n.set(l,c)}copy(e){return super.copy(e),this.aX=e.aX,this.aY=e.aY,this.xRadius=e.xRadius,this.yRadius=e.yRadius,this.aStartAngle=e.aStartAngle,this.aEndAngle=e.aEndAngle,this.aClockwise=e.aClockwise,this.aRotation=e.aRotation,this}toJSON(){let e=super.toJSON();return e.aX=this.aX,e.aY=this.aY,e.xRadius=this.xRadius,e.yRadius=this.yRadius,e.aStartAngle=this.aStartAngle,e.aEndAngle=this.aEndAngle,e.aClockwise=this.aClockwise,e.aRotation=this.aRotation,e}fromJSON(e){return super.fromJSON(e),this.aX=e.aX,this.aY=e.aY,this.xRadius=e.xRadius,this.yRadius=e.yRadius,this.aStartAngle=e.aStartAngle,this.aEndAngle=e.aEndAngle,this.aClockwise=e.aClockwise,this.aRotation=e.aRotation,this}},oc=class extends ho{constructor(e,t,n,s,r,o){super(e,t,n,n,s,r,o),this.isArcCurve=!0,this.type="ArcCurve"}};function Dd(){let i=0,e=0,t=0,n=0;function s(r,o,a,l){i=r,e=a,t=-3*r+3*o-2*a-l,n=2*r-2*o+a+l}return{initCatmullRom:function(r,o,a,l,c){s(o,a,c*(a-r),c*(l-o))},initNonuniformCatmullRom:function(r,o,a,l,c,h,d){let u=(o-r)/c-(a-r)/(c+h)+(a-o)/h,f=(a-o)/h-(l-o)/(h+d)+(l-a)/d;u*=h,f*=h,s(o,a,u,f)},calc:function(r){let o=r*r,a=o*r;return i+e*r+t*o+n*a}}}var Wp=new X,Xp=new X,Xu=new Dd,qu=new Dd,Yu=new Dd,ac=class extends ai{constructor(e=[],t=!1,n="centripetal",s=.5){super(),this.isCatmullRomCurve3=!0,this.type="CatmullRomCurve3",this.points=e,this.closed=t,this.curveType=n,this.tension=s}getPoint(e,t=new X){let n=t,s=this.points,r=s.length,o=(r-(this.closed?0:1))*e,a=Math.floor(o),l=o-a;this.closed?a+=a>0?0:(Math.floor(Math.abs(a)/r)+1)*r:l===0&&a===r-1&&(a=r-2,l=1);let c,h;this.closed||a>0?c=s[(a-1)%r]:(Xp.subVectors(s[0],s[1]).add(s[0]),c=Xp);let d=s[a%r],u=s[(a+1)%r];if(this.closed||a+2<r?h=s[(a+2)%r]:(Wp.subVectors(s[r-1],s[r-2]).add(s[r-1]),h=Wp),this.curveType==="centripetal"||this.curveType==="chordal"){let f=this.curveType==="chordal"?.5:.25,p=Math.pow(c.distanceToSquared(d),f),x=Math.pow(d.distanceToSquared(u),f),m=Math.pow(u.distanceToSquared(h),f);x<1e-4&&(x=1),p<1e-4&&(p=x),m<1e-4&&(m=x),Xu.initNonuniformCatmullRom(c.x,d.x,u.x,h.x,p,x,m),qu.initNonuniformCatmullRom(c.y,d.y,u.y,h.y,p,x,m),Yu.initNonuniformCatmullRom(c.z,d.z,u.z,h.z,p,x,m)}else this.curveType==="catmullrom"&&(Xu.initCatmullRom(c.x,d.x,u.x,h.x,this.tension),qu.initCatmullRom(c.y,d.y,u.y,h.y,this.tension),Yu.initCatmullRom(c.z,d.z,u.z,h.z,this.tension));return n.set(Xu.calc(l),qu.calc(l),Yu.calc(l)),n}copy(e){super.copy(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(s.clone())}return this.closed=e.closed,this.curveType=e.curveType,this.tension=e.tension,this}toJSON(){let e=super.toJSON();e.points=[];for(let t=0,n=this.points.length;t<n;t++){let s=this.points[t];e.points.push(s.toArray())}return e.closed=this.closed,e.curveType=this.curveType,e.tension=this.tension,e}fromJSON(e){super.fromJSON(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(new X().fromArray(s))}return this.closed=e.closed,this.curveType=e.curveType,this.tension=e.tension,this}};function qp(i,e,t,n,s){let r=(n-e)*.5,o=(s-t)*.5,a=i*i,l=i*a;return(2*t-2*n+r+o)*l+(-3*t+3*n-2*r-o)*a+r*i+t}function cv(i,e){let t=1-i;return t*t*e}function hv(i,e){return 2*(1-i)*i*e}function uv(i,e){return i*i*e}function ea(i,e,t,n){return cv(i,e)+hv(i,t)+uv(i,n)}function dv(i,e){let t=1-i;return t*t*t*e}function fv(i,e){let t=1-i;return 3*t*t*i*e}function pv(i,e){return 3*(1-i)*i*i*e}function mv(i,e){return i*i*i*e}function ta(i,e,t,n,s){return dv(i,e)+fv(i,t)+pv(i,n)+mv(i,s)}var xa=class extends ai{constructor(e=new De,t=new De,n=new De,s=new De){super(),this.isCubicBezierCurve=!0,this.type="CubicBezierCurve",this.v0=e,this.v1=t,this.v2=n,this.v3=s}getPoint(e,t=new De){let n=t,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return n.set(ta(e,s.x,r.x,o.x,a.x),ta(e,s.y,r.y,o.y,a.y)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this.v3.copy(e.v3),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e.v3=this.v3.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this.v3.fromArray(e.v3),this}},lc=class extends ai{constructor(e=new X,t=new X,n=new X,s=new X){super(),this.isCubicBezierCurve3=!0,this.type="CubicBezierCurve3",this.v0=e,this.v1=t,this.v2=n,this.v3=s}getPoint(e,t=new X){let n=t,s=this.v0,r=this.v1,o=this.v2,a=this.v3;return n.set(ta(e,s.x,r.x,o.x,a.x),ta(e,s.y,r.y,o.y,a.y),ta(e,s.z,r.z,o.z,a.z)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this.v3.copy(e.v3),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e.v3=this.v3.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this.v3.fromArray(e.v3),this}},ya=class extends ai{constructor(e=new De,t=new De){super(),this.isLineCurve=!0,this.type="LineCurve",this.v1=e,this.v2=t}getPoint(e,t=new De){let n=t;return e===1?n.copy(this.v2):(n.copy(this.v2).sub(this.v1),n.multiplyScalar(e).add(this.v1)),n}getPointAt(e,t){return this.getPoint(e,t)}getTangent(e,t=new De){return t.subVectors(this.v2,this.v1).normalize()}getTangentAt(e,t){return this.getTangent(e,t)}copy(e){return super.copy(e),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},cc=class extends ai{constructor(e=new X,t=new X){super(),this.isLineCurve3=!0,this.type="LineCurve3",this.v1=e,this.v2=t}getPoint(e,t=new X){let n=t;return e===1?n.copy(this.v2):(n.copy(this.v2).sub(this.v1),n.multiplyScalar(e).add(this.v1)),n}getPointAt(e,t){return this.getPoint(e,t)}getTangent(e,t=new X){return t.subVectors(this.v2,this.v1).normalize()}getTangentAt(e,t){return this.getTangent(e,t)}copy(e){return super.copy(e),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Sa=class extends ai{constructor(e=new De,t=new De,n=new De){super(),this.isQuadraticBezierCurve=!0,this.type="QuadraticBezierCurve",this.v0=e,this.v1=t,this.v2=n}getPoint(e,t=new De){let n=t,s=this.v0,r=this.v1,o=this.v2;return n.set(ea(e,s.x,r.x,o.x),ea(e,s.y,r.y,o.y)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},hc=class extends ai{constructor(e=new X,t=new X,n=new X){super(),this.isQuadraticBezierCurve3=!0,this.type="QuadraticBezierCurve3",this.v0=e,this.v1=t,this.v2=n}getPoint(e,t=new X){let n=t,s=this.v0,r=this.v1,o=this.v2;return n.set(ea(e,s.x,r.x,o.x),ea(e,s.y,r.y,o.y),ea(e,s.z,r.z,o.z)),n}copy(e){return super.copy(e),this.v0.copy(e.v0),this.v1.copy(e.v1),this.v2.copy(e.v2),this}toJSON(){let e=super.toJSON();return e.v0=this.v0.toArray(),e.v1=this.v1.toArray(),e.v2=this.v2.toArray(),e}fromJSON(e){return super.fromJSON(e),this.v0.fromArray(e.v0),this.v1.fromArray(e.v1),this.v2.fromArray(e.v2),this}},Ma=class extends ai{constructor(e=[]){super(),this.isSplineCurve=!0,this.type="SplineCurve",this.points=e}getPoint(e,t=new De){let n=t,s=this.points,r=(s.length-1)*e,o=Math.floor(r),a=r-o,l=s[o===0?o:o-1],c=s[o],h=s[o>s.length-2?s.length-1:o+1],d=s[o>s.length-3?s.length-1:o+2];return n.set(qp(a,l.x,c.x,h.x,d.x),qp(a,l.y,c.y,h.y,d.y)),n}copy(e){super.copy(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(s.clone())}return this}toJSON(){let e=super.toJSON();e.points=[];for(let t=0,n=this.points.length;t<n;t++){let s=this.points[t];e.points.push(s.toArray())}return e}fromJSON(e){super.fromJSON(e),this.points=[];for(let t=0,n=e.points.length;t<n;t++){let s=e.points[t];this.points.push(new De().fromArray(s))}return this}},ju=Object.freeze({__proto__:null,ArcCurve:oc,CatmullRomCurve3:ac,CubicBezierCurve:xa,CubicBezierCurve3:lc,EllipseCurve:ho,LineCurve:ya,LineCurve3:cc,QuadraticBezierCurve:Sa,QuadraticBezierCurve3:hc,SplineCurve:Ma}),uc=class extends ai{constructor(){super(),this.type="CurvePath",this.curves=[],this.autoClose=!1,this.cacheLengths=null}add(e){this.curves.push(e)}closePath(){let e=this.curves[0].getPoint(0),t=this.curves[this.curves.length-1].getPoint(1);if(!e.equals(t)){let n=e.isVector2===!0?"LineCurve":"LineCurve3";this.curves.push(new ju[n](t,e))}return this}getPoint(e,t){let n=e*this.getLength(),s=this.getCurveLengths(),r=0;for(;r<s.length;){if(s[r]>=n){let o=s[r]-n,a=this.curves[r],l=a.getLength(),c=l===0?0:1-o/l;return a.getPointAt(c,t)}r++}return null}getLength(){let e=this.getCurveLengths();return e[e.length-1]}updateArcLengths(){this.needsUpdate=!0,this.cacheLengths=null,this.getCurveLengths()}getCurveLengths(){if(this.cacheLengths&&this.cacheLengths.length===this.curves.length)return this.cacheLengths;let e=[],t=0;for(let n=0,s=this.curves.length;n<s;n++)t+=this.curves[n].getLength(),e.push(t);return this.cacheLengths=e,e}getSpacedPoints(e=40){let t=[];for(let n=0;n<=e;n++)t.push(this.getPoint(n/e));return this.autoClose&&t.push(t[0]),t}getPoints(e=12){let t=[],n;for(let s=0,r=this.curves;s<r.length;s++){let o=r[s],a=o.isEllipseCurve?e*2:o.isLineCurve||o.isLineCurve3?1:o.isSplineCurve?e*o.points.length:e,l=o.getPoints(a);for(let c=0;c<l.length;c++){let h=l[c];n&&n.equals(h)||(t.push(h),n=h)}}return this.autoClose&&t.length>1&&!t[t.length-1].equals(t[0])&&t.push(t[0]),t}copy(e){super.copy(e),this.curves=[];for(let t=0,n=e.curves.length;t<n;t++){let s=e.curves[t];this.curves.push(s.clone())}return this.autoClose=e.autoClose,this.cacheLengths=null,this}toJSON(){let e=super.toJSON();e.autoClose=this.autoClose,e.curves=[];for(let t=0,n=this.curves.length;t<n;t++){let s=this.curves[t];e.curves.push(s.toJSON())}return e}fromJSON(e){super.fromJSON(e),this.autoClose=e.autoClose,this.curves=[];for(let t=0,n=e.curves.length;t<n;t++){let s=e.curves[t];this.curves.push(new ju[s.type]().fromJSON(s))}return this.cacheLengths=null,this}},or=class extends uc{constructor(e){super(),this.type="Path",this.currentPoint=new De,e&&this.setFromPoints(e)}setFromPoints(e){this.moveTo(e[0].x,e[0].y);for(let t=1,n=e.length;t<n;t++)this.lineTo(e[t].x,e[t].y);return this}moveTo(e,t){return this.currentPoint.set(e,t),this}lineTo(e,t){let n=new ya(this.currentPoint.clone(),new De(e,t));return this.curves.push(n),this.currentPoint.set(e,t),this}quadraticCurveTo(e,t,n,s){let r=new Sa(this.currentPoint.clone(),new De(e,t),new De(n,s));return this.curves.push(r),this.currentPoint.set(n,s),this}bezierCurveTo(e,t,n,s,r,o){let a=new xa(this.currentPoint.clone(),new De(e,t),new De(n,s),new De(r,o));return this.curves.push(a),this.currentPoint.set(r,o),this}splineThru(e){let t=[this.currentPoint.clone()].concat(e),n=new Ma(t);return this.curves.push(n),this.currentPoint.copy(e[e.length-1]),this}arc(e,t,n,s,r,o){let a=this.currentPoint.x,l=this.currentPoint.y;return this.absarc(e+a,t+l,n,s,r,o),this}absarc(e,t,n,s,r,o){return this.absellipse(e,t,n,n,s,r,o),this}ellipse(e,t,n,s,r,o,a,l){let c=this.currentPoint.x,h=this.currentPoint.y;return this.absellipse(e+c,t+h,n,s,r,o,a,l),this}absellipse(e,t,n,s,r,o,a,l){let c=new ho(e,t,n,s,r,o,a,l);if(this.curves.length>0){let d=c.getPoint(0);d.equals(this.currentPoint)||this.lineTo(d.x,d.y)}this.curves.push(c);let h=c.getPoint(1);return this.currentPoint.copy(h),this}copy(e){return super.copy(e),this.currentPoint.copy(e.currentPoint),this}toJSON(){let e=super.toJSON();return e.currentPoint=this.currentPoint.toArray(),e}fromJSON(e){return super.fromJSON(e),this.currentPoint.fromArray(e.currentPoint),this}},ar=class extends or{constructor(e){super(e),this.uuid=Vs(),this.type="Shape",this.holes=[]}getPointsHoles(e){let t=[];for(let n=0,s=this.holes.length;n<s;n++)t[n]=this.holes[n].getPoints(e);return t}extractPoints(e){return{shape:this.getPoints(e),holes:this.getPointsHoles(e)}}copy(e){super.copy(e),this.holes=[];for(let t=0,n=e.holes.length;t<n;t++){let s=e.holes[t];this.holes.push(s.clone())}return this}toJSON(){let e=super.toJSON();e.uuid=this.uuid,e.holes=[];for(let t=0,n=this.holes.length;t<n;t++){let s=this.holes[t];e.holes.push(s.toJSON())}return e}fromJSON(e){super.fromJSON(e),this.uuid=e.uuid,this.holes=[];for(let t=0,n=e.holes.length;t<n;t++){let s=e.holes[t];this.holes.push(new or().fromJSON(s))}return this}};function gv(i,e,t=2){let n=e&&e.length,s=n?e[0]*t:i.length,r=Wm(i,0,s,t,!0),o=[];if(!r||r.next===r.prev)return o;let a,l,c;if(n&&(r=Sv(i,e,r,t)),i.length>80*t){a=i[0],l=i[1];let h=a,d=l;for(let u=t;u<s;u+=t){let f=i[u],p=i[u+1];f<a&&(a=f),p<l&&(l=p),f>h&&(h=f),p>d&&(d=p)}c=Math.max(h-a,d-l),c=c!==0?32767/c:0}return ba(r,o,t,a,l,c,0),o}function Wm(i,e,t,n,s){let r;if(s===Lv(i,e,t,n)>0)for(let o=e;o<t;o+=n)r=Yp(o/n|0,i[o],i[o+1],r);else for(let o=t-n;o>=e;o-=n)r=Yp(o/n|0,i[o],i[o+1],r);return r&&uo(r,r.next)&&(Ea(r),r=r.next),r}function lr(i,e){if(!i)return i;e||(e=i);let t=i,n;do if(n=!1,!t.steiner&&(uo(t,t.next)||sn(t.prev,t,t.next)===0)){if(Ea(t),t=e=t.prev,t===t.next)break;n=!0}else t=t.next;while(n||t!==e);return e}function ba(i,e,t,n,s,r,o){if(!i)return;!o&&r&&Tv(i,n,s,r);let a=i;for(;i.prev!==i.next;){let l=i.prev,c=i.next;if(r?vv(i,n,s,r):_v(i)){e.push(l.i,i.i,c.i),Ea(i),i=c.next,a=c.next;continue}if(i=c,i===a){o?o===1?(i=xv(lr(i),e),ba(i,e,t,n,s,r,2)):o===2&&yv(i,e,t,n,s,r):ba(lr(i),e,t,n,s,r,1);break}}}function _v(i){let e=i.prev,t=i,n=i.next;if(sn(e,t,n)>=0)return!1;let s=e.x,r=t.x,o=n.x,a=e.y,l=t.y,c=n.y,h=Math.min(s,r,o),d=Math.min(a,l,c),u=Math.max(s,r,o),f=Math.max(a,l,c),p=n.next;for(;p!==e;){if(p.x>=h&&p.x<=u&&p.y>=d&&p.y<=f&&Qo(s,a,r,l,o,c,p.x,p.y)&&sn(p.prev,p,p.next)>=0)return!1;p=p.next}return!0}function vv(i,e,t,n){let s=i.prev,r=i,o=i.next;if(sn(s,r,o)>=0)return!1;let a=s.x,l=r.x,c=o.x,h=s.y,d=r.y,u=o.y,f=Math.min(a,l,c),p=Math.min(h,d,u),x=Math.max(a,l,c),m=Math.max(h,d,u),g=ed(f,p,e,t,n),S=ed(x,m,e,t,n),T=i.prevZ,y=i.nextZ;for(;T&&T.z>=g&&y&&y.z<=S;){if(T.x>=f&&T.x<=x&&T.y>=p&&T.y<=m&&T!==s&&T!==o&&Qo(a,h,l,d,c,u,T.x,T.y)&&sn(T.prev,T,T.next)>=0||(T=T.prevZ,y.x>=f&&y.x<=x&&y.y>=p&&y.y<=m&&y!==s&&y!==o&&Qo(a,h,l,d,c,u,y.x,y.y)&&sn(y.prev,y,y.next)>=0))return!1;y=y.nextZ}for(;T&&T.z>=g;){if(T.x>=f&&T.x<=x&&T.y>=p&&T.y<=m&&T!==s&&T!==o&&Qo(a,h,l,d,c,u,T.x,T.y)&&sn(T.prev,T,T.next)>=0)return!1;T=T.prevZ}for(;y&&y.z<=S;){if(y.x>=f&&y.x<=x&&y.y>=p&&y.y<=m&&y!==s&&y!==o&&Qo(a,h,l,d,c,u,y.x,y.y)&&sn(y.prev,y,y.next)>=0)return!1;y=y.nextZ}return!0}function xv(i,e){let t=i;do{let n=t.prev,s=t.next.next;!uo(n,s)&&qm(n,t,t.next,s)&&wa(n,s)&&wa(s,n)&&(e.push(n.i,t.i,s.i),Ea(t),Ea(t.next),t=i=s),t=t.next}while(t!==i);return lr(t)}function yv(i,e,t,n,s,r){let o=i;do{let a=o.next.next;for(;a!==o.prev;){if(o.i!==a.i&&Cv(o,a)){let l=Ym(o,a);o=lr(o,o.next),l=lr(l,l.next),ba(o,e,t,n,s,r,0),ba(l,e,t,n,s,r,0);return}a=a.next}o=o.next}while(o!==i)}function Sv(i,e,t,n){let s=[];for(let r=0,o=e.length;r<o;r++){let a=e[r]*n,l=r<o-1?e[r+1]*n:i.length,c=Wm(i,a,l,n,!1);c===c.next&&(c.steiner=!0),s.push(Rv(c))}s.sort(Mv);for(let r=0;r<s.length;r++)t=bv(s[r],t);return t}function Mv(i,e){let t=i.x-e.x;if(t===0&&(t=i.y-e.y,t===0)){let n=(i.next.y-i.y)/(i.next.x-i.x),s=(e.next.y-e.y)/(e.next.x-e.x);t=n-s}return t}function bv(i,e){let t=wv(i,e);if(!t)return e;let n=Ym(t,i);return lr(n,n.next),lr(t,t.next)}function wv(i,e){let t=e,n=i.x,s=i.y,r=-1/0,o;if(uo(i,t))return t;do{if(uo(i,t.next))return t.next;if(s<=t.y&&s>=t.next.y&&t.next.y!==t.y){let d=t.x+(s-t.y)*(t.next.x-t.x)/(t.next.y-t.y);if(d<=n&&d>r&&(r=d,o=t.x<t.next.x?t:t.next,d===n))return o}t=t.next}while(t!==e);if(!o)return null;let a=o,l=o.x,c=o.y,h=1/0;t=o;do{if(n>=t.x&&t.x>=l&&n!==t.x&&Xm(s<c?n:r,s,l,c,s<c?r:n,s,t.x,t.y)){let d=Math.abs(s-t.y)/(n-t.x);wa(t,i)&&(d<h||d===h&&(t.x>o.x||t.x===o.x&&Ev(o,t)))&&(o=t,h=d)}t=t.next}while(t!==a);return o}function Ev(i,e){return sn(i.prev,i,e.prev)<0&&sn(e.next,i,i.next)<0}function Tv(i,e,t,n){let s=i;do s.z===0&&(s.z=ed(s.x,s.y,e,t,n)),s.prevZ=s.prev,s.nextZ=s.next,s=s.next;while(s!==i);s.prevZ.nextZ=null,s.prevZ=null,Av(s)}function Av(i){let e,t=1;do{let n=i,s;i=null;let r=null;for(e=0;n;){e++;let o=n,a=0;for(let c=0;c<t&&(a++,o=o.nextZ,!!o);c++);let l=t;for(;a>0||l>0&&o;)a!==0&&(l===0||!o||n.z<=o.z)?(s=n,n=n.nextZ,a--):(s=o,o=o.nextZ,l--),r?r.nextZ=s:i=s,s.prevZ=r,r=s;n=o}r.nextZ=null,t*=2}while(e>1);return i}function ed(i,e,t,n,s){return i=(i-t)*s|0,e=(e-n)*s|0,i=(i|i<<8)&16711935,i=(i|i<<4)&252645135,i=(i|i<<2)&858993459,i=(i|i<<1)&1431655765,e=(e|e<<8)&16711935,e=(e|e<<4)&252645135,e=(e|e<<2)&858993459,e=(e|e<<1)&1431655765,i|e<<1}function Rv(i){let e=i,t=i;do(e.x<t.x||e.x===t.x&&e.y<t.y)&&(t=e),e=e.next;while(e!==i);return t}function Xm(i,e,t,n,s,r,o,a){return(s-o)*(e-a)>=(i-o)*(r-a)&&(i-o)*(n-a)>=(t-o)*(e-a)&&(t-o)*(r-a)>=(s-o)*(n-a)}function Qo(i,e,t,n,s,r,o,a){return!(i===o&&e===a)&&Xm(i,e,t,n,s,r,o,a)}function Cv(i,e){return i.next.i!==e.i&&i.prev.i!==e.i&&!Pv(i,e)&&(wa(i,e)&&wa(e,i)&&Iv(i,e)&&(sn(i.prev,i,e.prev)||sn(i,e.prev,e))||uo(i,e)&&sn(i.prev,i,i.next)>0&&sn(e.prev,e,e.next)>0)}function sn(i,e,t){return(e.y-i.y)*(t.x-e.x)-(e.x-i.x)*(t.y-e.y)}function uo(i,e){return i.x===e.x&&i.y===e.y}function qm(i,e,t,n){let s=Ul(sn(i,e,t)),r=Ul(sn(i,e,n)),o=Ul(sn(t,n,i)),a=Ul(sn(t,n,e));return!!(s!==r&&o!==a||s===0&&Nl(i,t,e)||r===0&&Nl(i,n,e)||o===0&&Nl(t,i,n)||a===0&&Nl(t,e,n))}function Nl(i,e,t){return e.x<=Math.max(i.x,t.x)&&e.x>=Math.min(i.x,t.x)&&e.y<=Math.max(i.y,t.y)&&e.y>=Math.min(i.y,t.y)}function Ul(i){return i>0?1:i<0?-1:0}function Pv(i,e){let t=i;do{if(t.i!==i.i&&t.next.i!==i.i&&t.i!==e.i&&t.next.i!==e.i&&qm(t,t.next,i,e))return!0;t=t.next}while(t!==i);return!1}function wa(i,e){return sn(i.prev,i,i.next)<0?sn(i,e,i.next)>=0&&sn(i,i.prev,e)>=0:sn(i,e,i.prev)<0||sn(i,i.next,e)<0}function Iv(i,e){let t=i,n=!1,s=(i.x+e.x)/2,r=(i.y+e.y)/2;do t.y>r!=t.next.y>r&&t.next.y!==t.y&&s<(t.next.x-t.x)*(r-t.y)/(t.next.y-t.y)+t.x&&(n=!n),t=t.next;while(t!==i);return n}function Ym(i,e){let t=td(i.i,i.x,i.y),n=td(e.i,e.x,e.y),s=i.next,r=e.prev;return i.next=e,e.prev=i,t.next=s,s.prev=t,n.next=t,t.prev=n,r.next=n,n.prev=r,n}function Yp(i,e,t,n){let s=td(i,e,t);return n?(s.next=n.next,s.prev=n,n.next.prev=s,n.next=s):(s.prev=s,s.next=s),s}function Ea(i){i.next.prev=i.prev,i.prev.next=i.next,i.prevZ&&(i.prevZ.nextZ=i.nextZ),i.nextZ&&(i.nextZ.prevZ=i.prevZ)}function td(i,e,t){return{i,x:e,y:t,prev:null,next:null,z:0,prevZ:null,nextZ:null,steiner:!1}}function Lv(i,e,t,n){let s=0;for(let r=e,o=t-n;r<t;r+=n)s+=(i[o]-i[r])*(i[r+1]+i[o+1]),o=r;return s}var nd=class{static triangulate(e,t,n=2){return gv(e,t,n)}},ir=class i{static area(e){let t=e.length,n=0;for(let s=t-1,r=0;r<t;s=r++)n+=e[s].x*e[r].y-e[r].x*e[s].y;return n*.5}static isClockWise(e){return i.area(e)<0}static triangulateShape(e,t){let n=[],s=[],r=[];$p(e),Zp(n,e);let o=e.length;t.forEach($p);for(let l=0;l<t.length;l++)s.push(o),o+=t[l].length,Zp(n,t[l]);let a=nd.triangulate(n,s);for(let l=0;l<a.length;l+=3)r.push(a.slice(l,l+3));return r}};function $p(i){let e=i.length;e>2&&i[e-1].equals(i[0])&&i.pop()}function Zp(i,e){for(let t=0;t<e.length;t++)i.push(e[t].x),i.push(e[t].y)}var fo=class i extends Jt{constructor(e=new ar([new De(.5,.5),new De(-.5,.5),new De(-.5,-.5),new De(.5,-.5)]),t={}){super(),this.type="ExtrudeGeometry",this.parameters={shapes:e,options:t},e=Array.isArray(e)?e:[e];let n=this,s=[],r=[];for(let a=0,l=e.length;a<l;a++){let c=e[a];o(c)}this.setAttribute("position",new Lt(s,3)),this.setAttribute("uv",new Lt(r,2)),this.computeVertexNormals();function o(a){let l=[],c=t.curveSegments!==void 0?t.curveSegments:12,h=t.steps!==void 0?t.steps:1,d=t.depth!==void 0?t.depth:1,u=t.bevelEnabled!==void 0?t.bevelEnabled:!0,f=t.bevelThickness!==void 0?t.bevelThickness:.2,p=t.bevelSize!==void 0?t.bevelSize:f-.1,x=t.bevelOffset!==void 0?t.bevelOffset:0,m=t.bevelSegments!==void 0?t.bevelSegments:3,g=t.extrudePath,S=t.UVGenerator!==void 0?t.UVGenerator:Dv,T,y=!1,C,A,v,E;if(g){T=g.getSpacedPoints(h),y=!0,u=!1;let oe=g.isCatmullRomCurve3?g.closed:!1;C=g.computeFrenetFrames(h,oe),A=new X,v=new X,E=new X}u||(m=0,f=0,p=0,x=0);let k=a.extractPoints(c),N=k.shape,I=k.holes;if(!ir.isClockWise(N)){N=N.reverse();for(let oe=0,xe=I.length;oe<xe;oe++){let _e=I[oe];ir.isClockWise(_e)&&(I[oe]=_e.reverse())}}function W(oe){let _e=10000000000000001e-36,Be=oe[0];for(let Le=1;Le<=oe.length;Le++){let nt=Le%oe.length,ke=oe[nt],gt=ke.x-Be.x,dt=ke.y-Be.y,vt=gt*gt+dt*dt,U=Math.max(Math.abs(ke.x),Math.abs(ke.y),Math.abs(Be.x),Math.abs(Be.y)),Se=_e*U*U;if(vt<=Se){oe.splice(nt,1),Le--;continue}Be=ke}}W(N),I.forEach(W);let L=I.length,H=N;for(let oe=0;oe<L;oe++){let xe=I[oe];N=N.concat(xe)}function Y(oe,xe,_e){return xe||at("ExtrudeGeometry: vec does not exist"),oe.clone().addScaledVector(xe,_e)}let z=N.length;function ce(oe,xe,_e){let Be,Le,nt,ke=oe.x-xe.x,gt=oe.y-xe.y,dt=_e.x-oe.x,vt=_e.y-oe.y,U=ke*ke+gt*gt,Se=ke*vt-gt*dt;if(Math.abs(Se)>Number.EPSILON){let Xe=Math.sqrt(U),ht=Math.sqrt(dt*dt+vt*vt),we=xe.x-gt/Xe,Nt=xe.y+ke/Xe,$e=_e.x-vt/ht,je=_e.y+dt/ht,R=(($e-we)*vt-(je-Nt)*dt)/(ke*vt-gt*dt);Be=we+ke*R-oe.x,Le=Nt+gt*R-oe.y;let M=Be*Be+Le*Le;if(M<=2)return new De(Be,Le);nt=Math.sqrt(M/2)}else{let Xe=!1;ke>Number.EPSILON?dt>Number.EPSILON&&(Xe=!0):ke<-Number.EPSILON?dt<-Number.EPSILON&&(Xe=!0):Math.sign(gt)===Math.sign(vt)&&(Xe=!0),Xe?(Be=-gt,Le=ke,nt=Math.sqrt(U)):(Be=ke,Le=gt,nt=Math.sqrt(U/2))}return new De(Be/nt,Le/nt)}let J=[];for(let oe=0,xe=H.length,_e=xe-1,Be=oe+1;oe<xe;oe++,_e++,Be++)_e===xe&&(_e=0),Be===xe&&(Be=0),J[oe]=ce(H[oe],H[_e],H[Be]);let j=[],te,fe=J.concat();for(let oe=0,xe=L;oe<xe;oe++){let _e=I[oe];te=[];for(let Be=0,Le=_e.length,nt=Le-1,ke=Be+1;Be<Le;Be++,nt++,ke++)nt===Le&&(nt=0),ke===Le&&(ke=0),te[Be]=ce(_e[Be],_e[nt],_e[ke]);j.push(te),fe=fe.concat(te)}let he;if(m===0)he=ir.triangulateShape(H,I);else{let oe=[],xe=[];for(let _e=0;_e<m;_e++){let Be=_e/m,Le=f*Math.cos(Be*Math.PI/2),nt=p*Math.sin(Be*Math.PI/2)+x;for(let ke=0,gt=H.length;ke<gt;ke++){let dt=Y(H[ke],J[ke],nt);Ge(dt.x,dt.y,-Le),Be===0&&oe.push(dt)}for(let ke=0,gt=L;ke<gt;ke++){let dt=I[ke];te=j[ke];let vt=[];for(let U=0,Se=dt.length;U<Se;U++){let Xe=Y(dt[U],te[U],nt);Ge(Xe.x,Xe.y,-Le),Be===0&&vt.push(Xe)}Be===0&&xe.push(vt)}}he=ir.triangulateShape(oe,xe)}let ee=he.length,ge=p+x;for(let oe=0;oe<z;oe++){let xe=u?Y(N[oe],fe[oe],ge):N[oe];y?(v.copy(C.normals[0]).multiplyScalar(xe.x),A.copy(C.binormals[0]).multiplyScalar(xe.y),E.copy(T[0]).add(v).add(A),Ge(E.x,E.y,E.z)):Ge(xe.x,xe.y,0)}for(let oe=1;oe<=h;oe++)for(let xe=0;xe<z;xe++){let _e=u?Y(N[xe],fe[xe],ge):N[xe];y?(v.copy(C.normals[oe]).multiplyScalar(_e.x),A.copy(C.binormals[oe]).multiplyScalar(_e.y),E.copy(T[oe]).add(v).add(A),Ge(E.x,E.y,E.z)):Ge(_e.x,_e.y,d/h*oe)}for(let oe=m-1;oe>=0;oe--){let xe=oe/m,_e=f*Math.cos(xe*Math.PI/2),Be=p*Math.sin(xe*Math.PI/2)+x;for(let Le=0,nt=H.length;Le<nt;Le++){let ke=Y(H[Le],J[Le],Be);Ge(ke.x,ke.y,d+_e)}for(let Le=0,nt=I.length;Le<nt;Le++){let ke=I[Le];te=j[Le];for(let gt=0,dt=ke.length;gt<dt;gt++){let vt=Y(ke[gt],te[gt],Be);y?Ge(vt.x,vt.y+T[h-1].y,T[h-1].x+_e):Ge(vt.x,vt.y,d+_e)}}}ve(),Ie();function ve(){let oe=s.length/3;if(u){let xe=0,_e=z*xe;for(let Be=0;Be<ee;Be++){let Le=he[Be];st(Le[2]+_e,Le[1]+_e,Le[0]+_e)}xe=h+m*2,_e=z*xe;for(let Be=0;Be<ee;Be++){let Le=he[Be];st(Le[0]+_e,Le[1]+_e,Le[2]+_e)}}else{for(let xe=0;xe<ee;xe++){let _e=he[xe];st(_e[2],_e[1],_e[0])}for(let xe=0;xe<ee;xe++){let _e=he[xe];st(_e[0]+z*h,_e[1]+z*h,_e[2]+z*h)}}n.addGroup(oe,s.length/3-oe,0)}function Ie(){let oe=s.length/3,xe=0;be(H,xe),xe+=H.length;for(let _e=0,Be=I.length;_e<Be;_e++){let Le=I[_e];be(Le,xe),xe+=Le.length}n.addGroup(oe,s.length/3-oe,1)}function be(oe,xe){let _e=oe.length;for(;--_e>=0;){let Be=_e,Le=_e-1;Le<0&&(Le=oe.length-1);for(let nt=0,ke=h+m*2;nt<ke;nt++){let gt=z*nt,dt=z*(nt+1),vt=xe+Be+gt,U=xe+Le+gt,Se=xe+Le+dt,Xe=xe+Be+dt;Je(vt,U,Se,Xe)}}}function Ge(oe,xe,_e){l.push(oe),l.push(xe),l.push(_e)}function st(oe,xe,_e){rt(oe),rt(xe),rt(_e);let Be=s.length/3,Le=S.generateTopUV(n,s,Be-3,Be-2,Be-1);it(Le[0]),it(Le[1]),it(Le[2])}function Je(oe,xe,_e,Be){rt(oe),rt(xe),rt(Be),rt(xe),rt(_e),rt(Be);let Le=s.length/3,nt=S.generateSideWallUV(n,s,Le-6,Le-3,Le-2,Le-1);it(nt[0]),it(nt[1]),it(nt[3]),it(nt[1]),it(nt[2]),it(nt[3])}function rt(oe){s.push(l[oe*3+0]),s.push(l[oe*3+1]),s.push(l[oe*3+2])}function it(oe){r.push(oe.x),r.push(oe.y)}}}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}toJSON(){let e=super.toJSON(),t=this.parameters.shapes,n=this.parameters.options;return Nv(t,n,e)}static fromJSON(e,t){let n=[];for(let r=0,o=e.shapes.length;r<o;r++){let a=t[e.shapes[r]];n.push(a)}let s=e.options.extrudePath;return s!==void 0&&(e.options.extrudePath=new ju[s.type]().fromJSON(s)),new i(n,e.options)}},Dv={generateTopUV:function(i,e,t,n,s){let r=e[t*3],o=e[t*3+1],a=e[n*3],l=e[n*3+1],c=e[s*3],h=e[s*3+1];return[new De(r,o),new De(a,l),new De(c,h)]},generateSideWallUV:function(i,e,t,n,s,r){let o=e[t*3],a=e[t*3+1],l=e[t*3+2],c=e[n*3],h=e[n*3+1],d=e[n*3+2],u=e[s*3],f=e[s*3+1],p=e[s*3+2],x=e[r*3],m=e[r*3+1],g=e[r*3+2];return Math.abs(a-h)<Math.abs(o-c)?[new De(o,1-l),new De(c,1-d),new De(u,1-p),new De(x,1-g)]:[new De(a,1-l),new De(h,1-d),new De(f,1-p),new De(m,1-g)]}};function Nv(i,e,t){if(t.shapes=[],Array.isArray(i))for(let n=0,s=i.length;n<s;n++){let r=i[n];t.shapes.push(r.uuid)}else t.shapes.push(i.uuid);return t.options=Object.assign({},e),e.extrudePath!==void 0&&(t.options.extrudePath=e.extrudePath.toJSON()),t}var Ta=class i extends Jt{constructor(e=1,t=1,n=1,s=1){super(),this.type="PlaneGeometry",this.parameters={width:e,height:t,widthSegments:n,heightSegments:s};let r=e/2,o=t/2,a=Math.floor(n),l=Math.floor(s),c=a+1,h=l+1,d=e/a,u=t/l,f=[],p=[],x=[],m=[];for(let g=0;g<h;g++){let S=g*u-o;for(let T=0;T<c;T++){let y=T*d-r;p.push(y,-S,0),x.push(0,0,1),m.push(T/a),m.push(1-g/l)}}for(let g=0;g<l;g++)for(let S=0;S<a;S++){let T=S+c*g,y=S+c*(g+1),C=S+1+c*(g+1),A=S+1+c*g;f.push(T,y,A),f.push(y,C,A)}this.setIndex(f),this.setAttribute("position",new Lt(p,3)),this.setAttribute("normal",new Lt(x,3)),this.setAttribute("uv",new Lt(m,2))}copy(e){return super.copy(e),this.parameters=Object.assign({},e.parameters),this}static fromJSON(e){return new i(e.width,e.height,e.widthSegments,e.heightSegments)}};function pr(i){let e={};for(let t in i){e[t]={};for(let n in i[t]){let s=i[t][n];if(Jp(s))s.isRenderTargetTexture?(tt("UniformsUtils: Textures of render targets cannot be cloned via cloneUniforms() or mergeUniforms()."),e[t][n]=null):e[t][n]=s.clone();else if(Array.isArray(s))if(Jp(s[0])){let r=[];for(let o=0,a=s.length;o<a;o++)r[o]=s[o].clone();e[t][n]=r}else e[t][n]=s.slice();else e[t][n]=s}}return e}function zn(i){let e={};for(let t=0;t<i.length;t++){let n=pr(i[t]);for(let s in n)e[s]=n[s]}return e}function Jp(i){return i&&(i.isColor||i.isMatrix3||i.isMatrix4||i.isVector2||i.isVector3||i.isVector4||i.isTexture||i.isQuaternion)}function Uv(i){let e=[];for(let t=0;t<i.length;t++)e.push(i[t].clone());return e}function Nd(i){let e=i.getRenderTarget();return e===null?i.outputColorSpace:e.isXRRenderTarget===!0?e.texture.colorSpace:Tt.workingColorSpace}var $m={clone:pr,merge:zn},Fv=`void main() {
	gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
}`,Ov=`void main() {
	gl_FragColor = vec4( 1.0, 0.0, 0.0, 1.0 );
}`,Ji=class extends Zi{constructor(e){super(),this.isShaderMaterial=!0,this.type="ShaderMaterial",this.defines={},this.uniforms={},this.uniformsGroups=[],this.vertexShader=Fv,this.fragmentShader=Ov,this.linewidth=1,this.wireframe=!1,this.wireframeLinewidth=1,this.fog=!1,this.lights=!1,this.clipping=!1,this.forceSinglePass=!0,this.extensions={clipCullDistance:!1,multiDraw:!1},this.defaultAttributeValues={color:[1,1,1],uv:[0,0],uv1:[0,0]},this.index0AttributeName=void 0,this.uniformsNeedUpdate=!1,this.glslVersion=null,e!==void 0&&this.setValues(e)}copy(e){return super.copy(e),this.fragmentShader=e.fragmentShader,this.vertexShader=e.vertexShader,this.uniforms=pr(e.uniforms),this.uniformsGroups=Uv(e.uniformsGroups),this.defines=Object.assign({},e.defines),this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.fog=e.fog,this.lights=e.lights,this.clipping=e.clipping,this.extensions=Object.assign({},e.extensions),this.glslVersion=e.glslVersion,this.defaultAttributeValues=Object.assign({},e.defaultAttributeValues),this.index0AttributeName=e.index0AttributeName,this.uniformsNeedUpdate=e.uniformsNeedUpdate,this}toJSON(e){let t=super.toJSON(e);t.glslVersion=this.glslVersion,t.uniforms={};for(let s in this.uniforms){let o=this.uniforms[s].value;o&&o.isTexture?t.uniforms[s]={type:"t",value:o.toJSON(e).uuid}:o&&o.isColor?t.uniforms[s]={type:"c",value:o.getHex()}:o&&o.isVector2?t.uniforms[s]={type:"v2",value:o.toArray()}:o&&o.isVector3?t.uniforms[s]={type:"v3",value:o.toArray()}:o&&o.isVector4?t.uniforms[s]={type:"v4",value:o.toArray()}:o&&o.isMatrix3?t.uniforms[s]={type:"m3",value:o.toArray()}:o&&o.isMatrix4?t.uniforms[s]={type:"m4",value:o.toArray()}:t.uniforms[s]={value:o}}Object.keys(this.defines).length>0&&(t.defines=this.defines),t.vertexShader=this.vertexShader,t.fragmentShader=this.fragmentShader,t.lights=this.lights,t.clipping=this.clipping;let n={};for(let s in this.extensions)this.extensions[s]===!0&&(n[s]=!0);return Object.keys(n).length>0&&(t.extensions=n),t}fromJSON(e,t){if(super.fromJSON(e,t),e.uniforms!==void 0)for(let n in e.uniforms){let s=e.uniforms[n];switch(this.uniforms[n]={},s.type){case"t":this.uniforms[n].value=t[s.value]||null;break;case"c":this.uniforms[n].value=new pt().setHex(s.value);break;case"v2":this.uniforms[n].value=new De().fromArray(s.value);break;case"v3":this.uniforms[n].value=new X().fromArray(s.value);break;case"v4":this.uniforms[n].value=new tn().fromArray(s.value);break;case"m3":this.uniforms[n].value=new ft().fromArray(s.value);break;case"m4":this.uniforms[n].value=new Ft().fromArray(s.value);break;default:this.uniforms[n].value=s.value}}if(e.defines!==void 0&&(this.defines=e.defines),e.vertexShader!==void 0&&(this.vertexShader=e.vertexShader),e.fragmentShader!==void 0&&(this.fragmentShader=e.fragmentShader),e.glslVersion!==void 0&&(this.glslVersion=e.glslVersion),e.extensions!==void 0)for(let n in e.extensions)this.extensions[n]=e.extensions[n];return e.lights!==void 0&&(this.lights=e.lights),e.clipping!==void 0&&(this.clipping=e.clipping),this}},dc=class extends Ji{constructor(e){super(e),this.isRawShaderMaterial=!0,this.type="RawShaderMaterial"}};var Aa=class extends Zi{constructor(e){super(),this.isMeshLambertMaterial=!0,this.type="MeshLambertMaterial",this.color=new pt(16777215),this.map=null,this.lightMap=null,this.lightMapIntensity=1,this.aoMap=null,this.aoMapIntensity=1,this.emissive=new pt(0),this.emissiveIntensity=1,this.emissiveMap=null,this.bumpMap=null,this.bumpScale=1,this.normalMap=null,this.normalMapType=ph,this.normalScale=new De(1,1),this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.specularMap=null,this.alphaMap=null,this.envMap=null,this.envMapRotation=new ps,this.combine=Rc,this.reflectivity=1,this.envMapIntensity=1,this.refractionRatio=.98,this.wireframe=!1,this.wireframeLinewidth=1,this.wireframeLinecap="round",this.wireframeLinejoin="round",this.flatShading=!1,this.fog=!0,this.setValues(e)}copy(e){return super.copy(e),this.color.copy(e.color),this.map=e.map,this.lightMap=e.lightMap,this.lightMapIntensity=e.lightMapIntensity,this.aoMap=e.aoMap,this.aoMapIntensity=e.aoMapIntensity,this.emissive.copy(e.emissive),this.emissiveMap=e.emissiveMap,this.emissiveIntensity=e.emissiveIntensity,this.bumpMap=e.bumpMap,this.bumpScale=e.bumpScale,this.normalMap=e.normalMap,this.normalMapType=e.normalMapType,this.normalScale.copy(e.normalScale),this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.specularMap=e.specularMap,this.alphaMap=e.alphaMap,this.envMap=e.envMap,this.envMapRotation.copy(e.envMapRotation),this.combine=e.combine,this.reflectivity=e.reflectivity,this.envMapIntensity=e.envMapIntensity,this.refractionRatio=e.refractionRatio,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this.wireframeLinecap=e.wireframeLinecap,this.wireframeLinejoin=e.wireframeLinejoin,this.flatShading=e.flatShading,this.fog=e.fog,this}},fc=class extends Zi{constructor(e){super(),this.isMeshDepthMaterial=!0,this.type="MeshDepthMaterial",this.depthPacking=Am,this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.wireframe=!1,this.wireframeLinewidth=1,this.setValues(e)}copy(e){return super.copy(e),this.depthPacking=e.depthPacking,this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this.wireframe=e.wireframe,this.wireframeLinewidth=e.wireframeLinewidth,this}},pc=class extends Zi{constructor(e){super(),this.isMeshDistanceMaterial=!0,this.type="MeshDistanceMaterial",this.map=null,this.alphaMap=null,this.displacementMap=null,this.displacementScale=1,this.displacementBias=0,this.setValues(e)}copy(e){return super.copy(e),this.map=e.map,this.alphaMap=e.alphaMap,this.displacementMap=e.displacementMap,this.displacementScale=e.displacementScale,this.displacementBias=e.displacementBias,this}};function Jr(i,e){return!i||i.constructor===e?i:typeof e.BYTES_PER_ELEMENT=="number"?new e(i):Array.prototype.slice.call(i)}function Fl(i){return i!==void 0&&i.inTangents!==void 0&&i.outTangents!==void 0}var Bs=class{constructor(e,t,n,s){this.parameterPositions=e,this._cachedIndex=0,this.resultBuffer=s!==void 0?s:new t.constructor(n),this.sampleValues=t,this.valueSize=n,this.settings=null,this.DefaultSettings_={}}evaluate(e){let t=this.parameterPositions,n=this._cachedIndex,s=t[n],r=t[n-1];n:{e:{let o;t:{i:if(!(e<s)){for(let a=n+2;;){if(s===void 0){if(e<r)break i;return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}if(n===a)break;if(r=s,s=t[++n],e<s)break e}o=t.length;break t}if(!(e>=r)){let a=t[1];e<a&&(n=2,r=a);for(let l=n-2;;){if(r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(n===l)break;if(s=r,r=t[--n-1],e>=r)break e}o=n,n=0;break t}break n}for(;n<o;){let a=n+o>>>1;e<t[a]?o=a:n=a+1}if(s=t[n],r=t[n-1],r===void 0)return this._cachedIndex=0,this.copySampleValue_(0);if(s===void 0)return n=t.length,this._cachedIndex=n,this.copySampleValue_(n-1)}this._cachedIndex=n,this.intervalChanged_(n,r,s)}return this.interpolate_(n,r,e,s)}getSettings_(){return this.settings||this.DefaultSettings_}copySampleValue_(e){let t=this.resultBuffer,n=this.sampleValues,s=this.valueSize,r=e*s;for(let o=0;o!==s;++o)t[o]=n[r+o];return t}interpolate_(){throw new Error("THREE.Interpolant: Call to abstract method.")}intervalChanged_(){}},mc=class extends Bs{constructor(e,t,n,s){super(e,t,n,s),this._weightPrev=-0,this._offsetPrev=-0,this._weightNext=-0,this._offsetNext=-0,this.DefaultSettings_={endingStart:Ju,endingEnd:Ju}}intervalChanged_(e,t,n){let s=this.parameterPositions,r=e-2,o=e+1,a=s[r],l=s[o];if(a===void 0)switch(this.getSettings_().endingStart){case Ku:r=e,a=2*t-n;break;case Qu:r=s.length-2,a=t+s[r]-s[r+1];break;default:r=e,a=n}if(l===void 0)switch(this.getSettings_().endingEnd){case Ku:o=e,l=2*n-t;break;case Qu:o=1,l=n+s[1]-s[0];break;default:o=e-1,l=t}let c=(n-t)*.5,h=this.valueSize;this._weightPrev=c/(t-a),this._weightNext=c/(l-n),this._offsetPrev=r*h,this._offsetNext=o*h}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this._offsetPrev,d=this._offsetNext,u=this._weightPrev,f=this._weightNext,p=(n-t)/(s-t),x=p*p,m=x*p,g=-u*m+2*u*x-u*p,S=(1+u)*m+(-1.5-2*u)*x+(-.5+u)*p+1,T=(-1-f)*m+(1.5+f)*x+.5*p,y=f*m-f*x;for(let C=0;C!==a;++C)r[C]=g*o[h+C]+S*o[c+C]+T*o[l+C]+y*o[d+C];return r}},gc=class extends Bs{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=(n-t)/(s-t),d=1-h;for(let u=0;u!==a;++u)r[u]=o[c+u]*d+o[l+u]*h;return r}},_c=class extends Bs{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e){return this.copySampleValue_(e-1)}},vc=class extends Bs{interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=e*a,c=l-a,h=this.inTangents,d=this.outTangents;if(!h||!d){let p=(n-t)/(s-t),x=1-p;for(let m=0;m!==a;++m)r[m]=o[c+m]*x+o[l+m]*p;return r}let u=a*2,f=e-1;for(let p=0;p!==a;++p){let x=o[c+p],m=o[l+p],g=f*u+p*2,S=d[g],T=d[g+1],y=e*u+p*2,C=h[y],A=h[y+1],v=kv(n,t,S,C,s);r[p]=Zm(v,x,T,A,m)}return r}};function Zm(i,e,t,n,s){let r=1-i;return r*r*r*e+3*r*r*i*t+3*r*i*i*n+i*i*i*s}function Bv(i,e,t,n,s){let r=1-i;return 3*r*r*(t-e)+6*r*i*(n-t)+3*i*i*(s-n)}function kv(i,e,t,n,s){let r=(i-e)/(s-e);for(let o=0;o<8;o++){let a=Zm(r,e,t,n,s)-i;if(Math.abs(a)<1e-10)break;let l=Bv(r,e,t,n,s);if(Math.abs(l)<1e-10)break;r=Math.max(0,Math.min(1,r-a/l))}return r}var li=class{constructor(e,t,n,s){if(e===void 0)throw new Error("THREE.KeyframeTrack: track name is undefined");if(t===void 0||t.length===0)throw new Error("THREE.KeyframeTrack: no keyframes in track named "+e);this.name=e,this.times=Jr(t,this.TimeBufferType),this.values=Jr(n,this.ValueBufferType),this.setInterpolation(s||this.DefaultInterpolation)}static toJSON(e){let t=e.constructor,n;if(t.toJSON!==this.toJSON)n=t.toJSON(e);else{n={name:e.name,times:Jr(e.times,Array),values:Jr(e.values,Array)};let s=e.getInterpolation();s!==e.DefaultInterpolation&&(n.interpolation=s),Fl(e.settings)&&(n.settings={inTangents:Jr(e.settings.inTangents,Array),outTangents:Jr(e.settings.outTangents,Array)})}return n.type=e.ValueTypeName,n}InterpolantFactoryMethodDiscrete(e){return new _c(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodLinear(e){return new gc(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodSmooth(e){return new mc(this.times,this.values,this.getValueSize(),e)}InterpolantFactoryMethodBezier(e){let t=new vc(this.times,this.values,this.getValueSize(),e);return this.settings&&(t.inTangents=this.settings.inTangents,t.outTangents=this.settings.outTangents),t}setInterpolation(e){let t;switch(e){case na:t=this.InterpolantFactoryMethodDiscrete;break;case Kl:t=this.InterpolantFactoryMethodLinear;break;case kl:t=this.InterpolantFactoryMethodSmooth;break;case Zu:t=this.InterpolantFactoryMethodBezier;break}if(t===void 0){let n="unsupported interpolation for "+this.ValueTypeName+" keyframe track named "+this.name;if(this.createInterpolant===void 0)if(e!==this.DefaultInterpolation)this.setInterpolation(this.DefaultInterpolation);else throw new Error(n);return tt("KeyframeTrack:",n),this}return this.createInterpolant=t,this}getInterpolation(){switch(this.createInterpolant){case this.InterpolantFactoryMethodDiscrete:return na;case this.InterpolantFactoryMethodLinear:return Kl;case this.InterpolantFactoryMethodSmooth:return kl;case this.InterpolantFactoryMethodBezier:return Zu}}getValueSize(){return this.values.length/this.times.length}shift(e){if(e!==0){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]+=e;Fl(this.settings)&&(Kp(this.settings.inTangents,e),Kp(this.settings.outTangents,e))}return this}scale(e){if(e!==1){let t=this.times;for(let n=0,s=t.length;n!==s;++n)t[n]*=e;Fl(this.settings)&&(Qp(this.settings.inTangents,e),Qp(this.settings.outTangents,e))}return this}trim(e,t){let n=this.times,s=n.length,r=0,o=s-1;for(;r!==s&&n[r]<e;)++r;for(;o!==-1&&n[o]>t;)--o;if(++o,r!==0||o!==s){r>=o&&(o=Math.max(o,1),r=o-1);let a=this.getValueSize();this.times=n.slice(r,o),this.values=this.values.slice(r*a,o*a)}return this}validate(){let e=!0,t=this.getValueSize();t-Math.floor(t)!==0&&(at("KeyframeTrack: Invalid value size in track.",this),e=!1);let n=this.times,s=this.values,r=n.length;r===0&&(at("KeyframeTrack: Track is empty.",this),e=!1);let o=null;for(let a=0;a!==r;a++){let l=n[a];if(typeof l=="number"&&isNaN(l)){at("KeyframeTrack: Time is not a valid number.",this,a,l),e=!1;break}if(o!==null&&o>l){at("KeyframeTrack: Out of order keys.",this,a,l,o),e=!1;break}o=l}if(s!==void 0&&V_(s))for(let a=0,l=s.length;a!==l;++a){let c=s[a];if(isNaN(c)){at("KeyframeTrack: Value is not a valid number.",this,a,c),e=!1;break}}return e}optimize(){let e=this.times.slice(),t=this.values.slice(),n=this.getValueSize(),s=this.getInterpolation()===kl,r=e.length-1,o=1;for(let a=1;a<r;++a){let l=!1,c=e[a],h=e[a+1];if(c!==h&&(a!==1||c!==e[0]))if(s)l=!0;else{let d=a*n,u=d-n,f=d+n;for(let p=0;p!==n;++p){let x=t[d+p];if(x!==t[u+p]||x!==t[f+p]){l=!0;break}}}if(l){if(a!==o){e[o]=e[a];let d=a*n,u=o*n;for(let f=0;f!==n;++f)t[u+f]=t[d+f]}++o}}if(r>0){e[o]=e[r];for(let a=r*n,l=o*n,c=0;c!==n;++c)t[l+c]=t[a+c];++o}return o!==e.length?(this.times=e.slice(0,o),this.values=t.slice(0,o*n)):(this.times=e,this.values=t),this}clone(){let e=this.times.slice(),t=this.values.slice(),n=this.constructor,s=new n(this.name,e,t);return s.createInterpolant=this.createInterpolant,Fl(this.settings)&&(s.settings={inTangents:this.settings.inTangents.slice(),outTangents:this.settings.outTangents.slice()}),s}};function Kp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]+=e}function Qp(i,e){for(let t=0,n=i.length;t!==n;t+=2)i[t]*=e}li.prototype.ValueTypeName="";li.prototype.TimeBufferType=Float32Array;li.prototype.ValueBufferType=Float32Array;li.prototype.DefaultInterpolation=Kl;var ks=class extends li{constructor(e,t,n){super(e,t,n)}};ks.prototype.ValueTypeName="bool";ks.prototype.ValueBufferType=Array;ks.prototype.DefaultInterpolation=na;ks.prototype.InterpolantFactoryMethodLinear=void 0;ks.prototype.InterpolantFactoryMethodSmooth=void 0;var xc=class extends li{constructor(e,t,n,s){super(e,t,n,s)}};xc.prototype.ValueTypeName="color";var yc=class extends li{constructor(e,t,n,s){super(e,t,n,s)}};yc.prototype.ValueTypeName="number";var Sc=class extends Bs{constructor(e,t,n,s){super(e,t,n,s)}interpolate_(e,t,n,s){let r=this.resultBuffer,o=this.sampleValues,a=this.valueSize,l=(n-t)/(s-t),c=e*a;for(let h=c+a;c!==h;c+=4)_i.slerpFlat(r,0,o,c-a,o,c,l);return r}},Ra=class extends li{constructor(e,t,n,s){super(e,t,n,s)}InterpolantFactoryMethodLinear(e){return new Sc(this.times,this.values,this.getValueSize(),e)}};Ra.prototype.ValueTypeName="quaternion";Ra.prototype.InterpolantFactoryMethodSmooth=void 0;var zs=class extends li{constructor(e,t,n){super(e,t,n)}};zs.prototype.ValueTypeName="string";zs.prototype.ValueBufferType=Array;zs.prototype.DefaultInterpolation=na;zs.prototype.InterpolantFactoryMethodLinear=void 0;zs.prototype.InterpolantFactoryMethodSmooth=void 0;var Mc=class extends li{constructor(e,t,n,s){super(e,t,n,s)}};Mc.prototype.ValueTypeName="vector";var bc=class{constructor(e,t,n){let s=this,r=!1,o=0,a=0,l,c=[];this.onStart=void 0,this.onLoad=e,this.onProgress=t,this.onError=n,this._abortController=null,this.itemStart=function(h){a++,r===!1&&s.onStart!==void 0&&s.onStart(h,o,a),r=!0},this.itemEnd=function(h){o++,s.onProgress!==void 0&&s.onProgress(h,o,a),o===a&&(r=!1,s.onLoad!==void 0&&s.onLoad())},this.itemError=function(h){s.onError!==void 0&&s.onError(h)},this.resolveURL=function(h){return h=h.normalize("NFC"),l?l(h):h},this.setURLModifier=function(h){return l=h,this},this.addHandler=function(h,d){return c.push(h,d),this},this.removeHandler=function(h){let d=c.indexOf(h);return d!==-1&&c.splice(d,2),this},this.getHandler=function(h){for(let d=0,u=c.length;d<u;d+=2){let f=c[d],p=c[d+1];if(f.global&&(f.lastIndex=0),f.test(h))return p}return null},this.abort=function(){return this.abortController.abort(),this._abortController=null,this}}get abortController(){return this._abortController||(this._abortController=new AbortController),this._abortController}},Jm=new bc,wc=class{constructor(e){this.manager=e!==void 0?e:Jm,this.crossOrigin="anonymous",this.withCredentials=!1,this.path="",this.resourcePath="",this.requestHeader={},this.priority="auto",this.cache="default",typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}load(){}loadAsync(e,t){let n=this;return new Promise(function(s,r){n.load(e,s,t,r)})}parse(){}setCrossOrigin(e){return this.crossOrigin=e,this}setWithCredentials(e){return this.withCredentials=e,this}setPath(e){return this.path=e,this}setResourcePath(e){return this.resourcePath=e,this}setRequestHeader(e){return this.requestHeader=e,this}setPriority(e){return this.priority=e,this}setCache(e){return this.cache=e,this}abort(){return this}};wc.DEFAULT_MATERIAL_NAME="__DEFAULT";var Ca=class extends In{static registerNode(e){this.prototype._lightNode=e}constructor(e,t=1){super(),this.isLight=!0,this.type="Light",this.color=new pt(e),this.intensity=t}copy(e,t){return super.copy(e,t),this.color.copy(e.color),this.intensity=e.intensity,this}toJSON(e){let t=super.toJSON(e);return t.object.color=this.color.getHex(),t.object.intensity=this.intensity,t}},Pa=class extends Ca{constructor(e,t,n){super(e,n),this.isHemisphereLight=!0,this.type="HemisphereLight",this.position.copy(In.DEFAULT_UP),this.updateMatrix(),this.groundColor=new pt(t)}copy(e,t){return super.copy(e,t),this.groundColor.copy(e.groundColor),this}toJSON(e){let t=super.toJSON(e);return t.object.groundColor=this.groundColor.getHex(),t}},$u=new Ft,jp=new X,em=new X,Ec=class{constructor(e){this.camera=e,this.intensity=1,this.bias=0,this.biasNode=null,this.normalBias=0,this.radius=1,this.blurSamples=8,this.mapSize=new De(512,512),this.mapType=jn,this.map=null,this.mapPass=null,this.matrix=new Ft,this.autoUpdate=!0,this.needsUpdate=!1,this._frustum=new Fs,this._frameExtents=new De(1,1),this._viewportCount=1,this._viewports=[new tn(0,0,1,1)]}getViewportCount(){return this._viewportCount}getCamera(){return this.camera}getFrustum(){return this._frustum}updateMatrices(e){let t=this.camera;jp.setFromMatrixPosition(e.matrixWorld),t.position.copy(jp),em.setFromMatrixPosition(e.target.matrixWorld),t.lookAt(em),t.updateMatrixWorld(),this._updateMatrix(t,this.matrix,this._frustum)}_updateMatrix(e,t,n,s){$u.multiplyMatrices(e.projectionMatrix,e.matrixWorldInverse),n.setFromProjectionMatrix($u,e.coordinateSystem,e.reversedDepth);let r=this._frameExtents,o=s?s.z/r.x:1,a=s?s.w/r.y:1,l=s?s.x/r.x:0,c=s?s.y/r.y:0;e.coordinateSystem===to||e.reversedDepth?t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,1,0,0,0,0,1):t.set(.5*o,0,0,.5*o+l,0,.5*a,0,.5*a+c,0,0,.5,.5,0,0,0,1),t.multiply($u)}getViewport(e){return this._viewports[e]}getFrameExtents(){return this._frameExtents}dispose(){this.map&&this.map.dispose(),this.mapPass&&this.mapPass.dispose()}copy(e){return this.camera=e.camera.clone(),this.intensity=e.intensity,this.bias=e.bias,this.radius=e.radius,this.autoUpdate=e.autoUpdate,this.needsUpdate=e.needsUpdate,this.normalBias=e.normalBias,this.blurSamples=e.blurSamples,this.mapSize.copy(e.mapSize),this.mapType=e.mapType,this.biasNode=e.biasNode,this}clone(){return new this.constructor().copy(this)}toJSON(){let e={};return e.intensity=this.intensity,e.bias=this.bias,e.normalBias=this.normalBias,e.radius=this.radius,e.blurSamples=this.blurSamples,e.mapSize=this.mapSize.toArray(),e.mapType=this.mapType,e.camera=this.camera.toJSON(!1).object,delete e.camera.matrix,e}},Ol=new X,Bl=new _i,Wi=new X,Ia=class extends In{constructor(){super(),this.isCamera=!0,this.type="Camera",this.matrixWorldInverse=new Ft,this.projectionMatrix=new Ft,this.projectionMatrixInverse=new Ft,this.coordinateSystem=gi,this._reversedDepth=!1}get reversedDepth(){return this._reversedDepth}copy(e,t){return super.copy(e,t),this.matrixWorldInverse.copy(e.matrixWorldInverse),this.projectionMatrix.copy(e.projectionMatrix),this.projectionMatrixInverse.copy(e.projectionMatrixInverse),this.coordinateSystem=e.coordinateSystem,this}getWorldDirection(e){return super.getWorldDirection(e).negate()}updateMatrixWorld(e){super.updateMatrixWorld(e),this.matrixWorld.decompose(Ol,Bl,Wi),Wi.x===1&&Wi.y===1&&Wi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ol,Bl,Wi.set(1,1,1)).invert()}updateWorldMatrix(e,t,n=!1){super.updateWorldMatrix(e,t,n),this.matrixWorld.decompose(Ol,Bl,Wi),Wi.x===1&&Wi.y===1&&Wi.z===1?this.matrixWorldInverse.copy(this.matrixWorld).invert():this.matrixWorldInverse.compose(Ol,Bl,Wi.set(1,1,1)).invert()}clone(){return new this.constructor().copy(this)}},Ns=new X,tm=new De,nm=new De,Nn=class extends Ia{constructor(e=50,t=1,n=.1,s=2e3){super(),this.isPerspectiveCamera=!0,this.type="PerspectiveCamera",this.fov=e,this.zoom=1,this.near=n,this.far=s,this.focus=10,this.aspect=t,this.view=null,this.filmGauge=35,this.filmOffset=0,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.fov=e.fov,this.zoom=e.zoom,this.near=e.near,this.far=e.far,this.focus=e.focus,this.aspect=e.aspect,this.view=e.view===null?null:Object.assign({},e.view),this.filmGauge=e.filmGauge,this.filmOffset=e.filmOffset,this}setFocalLength(e){let t=.5*this.getFilmHeight()/e;this.fov=Ql*2*Math.atan(t),this.updateProjectionMatrix()}getFocalLength(){let e=Math.tan(Hl*.5*this.fov);return .5*this.getFilmHeight()/e}getEffectiveFOV(){return Ql*2*Math.atan(Math.tan(Hl*.5*this.fov)/this.zoom)}getFilmWidth(){return this.filmGauge*Math.min(this.aspect,1)}getFilmHeight(){return this.filmGauge/Math.max(this.aspect,1)}getViewBounds(e,t,n){Ns.set(-1,-1,.5).applyMatrix4(this.projectionMatrixInverse),t.set(Ns.x,Ns.y).multiplyScalar(-e/Ns.z),Ns.set(1,1,.5).applyMatrix4(this.projectionMatrixInverse),n.set(Ns.x,Ns.y).multiplyScalar(-e/Ns.z)}getViewSize(e,t){return this.getViewBounds(e,tm,nm),t.subVectors(nm,tm)}setViewOffset(e,t,n,s,r,o){this.aspect=e/t,this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=this.near,t=e*Math.tan(Hl*.5*this.fov)/this.zoom,n=2*t,s=this.aspect*n,r=-.5*s,o=this.view;if(this.view!==null&&this.view.enabled){let l=o.fullWidth,c=o.fullHeight;r+=o.offsetX*s/l,t-=o.offsetY*n/c,s*=o.width/l,n*=o.height/c}let a=this.filmOffset;a!==0&&(r+=e*a/this.getFilmWidth()),this.projectionMatrix.makePerspective(r,r+s,t,t-n,e,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.fov=this.fov,t.object.zoom=this.zoom,t.object.near=this.near,t.object.far=this.far,t.object.focus=this.focus,t.object.aspect=this.aspect,this.view!==null&&(t.object.view=Object.assign({},this.view)),t.object.filmGauge=this.filmGauge,t.object.filmOffset=this.filmOffset,t}};var cr=class extends Ia{constructor(e=-1,t=1,n=1,s=-1,r=.1,o=2e3){super(),this.isOrthographicCamera=!0,this.type="OrthographicCamera",this.zoom=1,this.view=null,this.left=e,this.right=t,this.top=n,this.bottom=s,this.near=r,this.far=o,this.updateProjectionMatrix()}copy(e,t){return super.copy(e,t),this.left=e.left,this.right=e.right,this.top=e.top,this.bottom=e.bottom,this.near=e.near,this.far=e.far,this.zoom=e.zoom,this.view=e.view===null?null:Object.assign({},e.view),this}setViewOffset(e,t,n,s,r,o){this.view===null&&(this.view={enabled:!0,fullWidth:1,fullHeight:1,offsetX:0,offsetY:0,width:1,height:1}),this.view.enabled=!0,this.view.fullWidth=e,this.view.fullHeight=t,this.view.offsetX=n,this.view.offsetY=s,this.view.width=r,this.view.height=o,this.updateProjectionMatrix()}clearViewOffset(){this.view!==null&&(this.view.enabled=!1),this.updateProjectionMatrix()}updateProjectionMatrix(){let e=(this.right-this.left)/(2*this.zoom),t=(this.top-this.bottom)/(2*this.zoom),n=(this.right+this.left)/2,s=(this.top+this.bottom)/2,r=n-e,o=n+e,a=s+t,l=s-t;if(this.view!==null&&this.view.enabled){let c=(this.right-this.left)/this.view.fullWidth/this.zoom,h=(this.top-this.bottom)/this.view.fullHeight/this.zoom;r+=c*this.view.offsetX,o=r+c*this.view.width,a-=h*this.view.offsetY,l=a-h*this.view.height}this.projectionMatrix.makeOrthographic(r,o,a,l,this.near,this.far,this.coordinateSystem,this.reversedDepth),this.projectionMatrixInverse.copy(this.projectionMatrix).invert()}toJSON(e){let t=super.toJSON(e);return t.object.zoom=this.zoom,t.object.left=this.left,t.object.right=this.right,t.object.top=this.top,t.object.bottom=this.bottom,t.object.near=this.near,t.object.far=this.far,this.view!==null&&(t.object.view=Object.assign({},this.view)),t}},id=class extends Ec{constructor(){super(new cr(-5,5,5,-5,.5,500)),this.isDirectionalLightShadow=!0}},La=class extends Ca{constructor(e,t){super(e,t),this.isDirectionalLight=!0,this.type="DirectionalLight",this.position.copy(In.DEFAULT_UP),this.updateMatrix(),this.target=new In,this.shadow=new id}dispose(){super.dispose(),this.shadow.dispose()}copy(e){return super.copy(e),this.target=e.target.clone(),this.shadow=e.shadow.clone(),this}toJSON(e){let t=super.toJSON(e);return t.object.shadow=this.shadow.toJSON(),t.object.target=this.target.uuid,t}};var Kr=-90,Qr=1,po=class extends In{constructor(e,t,n){super(),this.type="CubeCamera",this.renderTarget=n,this.coordinateSystem=null,this.activeMipmapLevel=0;let s=new Nn(Kr,Qr,e,t);s.layers=this.layers,this.add(s);let r=new Nn(Kr,Qr,e,t);r.layers=this.layers,this.add(r);let o=new Nn(Kr,Qr,e,t);o.layers=this.layers,this.add(o);let a=new Nn(Kr,Qr,e,t);a.layers=this.layers,this.add(a);let l=new Nn(Kr,Qr,e,t);l.layers=this.layers,this.add(l);let c=new Nn(Kr,Qr,e,t);c.layers=this.layers,this.add(c)}updateCoordinateSystem(){let e=this.coordinateSystem,t=this.children.concat(),[n,s,r,o,a,l]=t;for(let c of t)this.remove(c);if(e===gi)n.up.set(0,1,0),n.lookAt(1,0,0),s.up.set(0,1,0),s.lookAt(-1,0,0),r.up.set(0,0,-1),r.lookAt(0,1,0),o.up.set(0,0,1),o.lookAt(0,-1,0),a.up.set(0,1,0),a.lookAt(0,0,1),l.up.set(0,1,0),l.lookAt(0,0,-1);else if(e===to)n.up.set(0,-1,0),n.lookAt(-1,0,0),s.up.set(0,-1,0),s.lookAt(1,0,0),r.up.set(0,0,1),r.lookAt(0,1,0),o.up.set(0,0,-1),o.lookAt(0,-1,0),a.up.set(0,-1,0),a.lookAt(0,0,1),l.up.set(0,-1,0),l.lookAt(0,0,-1);else throw new Error("THREE.CubeCamera.updateCoordinateSystem(): Invalid coordinate system: "+e);for(let c of t)this.add(c),c.updateMatrixWorld()}update(e,t){this.parent===null&&this.updateMatrixWorld();let{renderTarget:n,activeMipmapLevel:s}=this;this.coordinateSystem!==e.coordinateSystem&&(this.coordinateSystem=e.coordinateSystem,this.updateCoordinateSystem());let[r,o,a,l,c,h]=this.children,d=e.getRenderTarget(),u=e.getActiveCubeFace(),f=e.getActiveMipmapLevel(),p=e.xr.enabled;e.xr.enabled=!1;let x=n.texture.mipmapsAutoUpdate;n.texture.mipmapsAutoUpdate=!1;let m=!1;e.isWebGLRenderer===!0?m=e.state.buffers.depth.getReversed():m=e.reversedDepthBuffer,e.setRenderTarget(n,0,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,r),e.setRenderTarget(n,1,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,o),e.setRenderTarget(n,2,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,a),e.setRenderTarget(n,3,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,l),e.setRenderTarget(n,4,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,c),n.texture.mipmapsAutoUpdate=x,e.setRenderTarget(n,5,s),m&&e.autoClear===!1&&e.clearDepth(),e.render(t,h),e.setRenderTarget(d,u,f),e.xr.enabled=p,n.texture.needsPMREMUpdate=!0}},Tc=class extends Nn{constructor(e=[]){super(),this.isArrayCamera=!0,this.isMultiViewCamera=!1,this.cameras=e,this.perCameraFrustumCulled=!1}};var Ud="\\[\\]\\.:\\/",zv=new RegExp("["+Ud+"]","g"),Fd="[^"+Ud+"]",Hv="[^"+Ud.replace("\\.","")+"]",Gv=/((?:WC+[\/:])*)/.source.replace("WC",Fd),Vv=/(WCOD+)?/.source.replace("WCOD",Hv),Wv=/(?:\.(WC+)(?:\[(.+)\])?)?/.source.replace("WC",Fd),Xv=/\.(WC+)(?:\[(.+)\])?/.source.replace("WC",Fd),qv=new RegExp("^"+Gv+Vv+Wv+Xv+"$"),Yv=["material","materials","bones","map"],sd=class{constructor(e,t,n){let s=n||Zt.parseTrackName(t);this._targetGroup=e,this._bindings=e.subscribe_(t,s)}getValue(e,t){this.bind();let n=this._targetGroup.nCachedObjects_,s=this._bindings[n];s!==void 0&&s.getValue(e,t)}setValue(e,t){let n=this._bindings;for(let s=this._targetGroup.nCachedObjects_,r=n.length;s!==r;++s)n[s].setValue(e,t)}bind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].bind()}unbind(){let e=this._bindings;for(let t=this._targetGroup.nCachedObjects_,n=e.length;t!==n;++t)e[t].unbind()}},Zt=class i{constructor(e,t,n){this.path=t,this.parsedPath=n||i.parseTrackName(t),this.node=i.findNode(e,this.parsedPath.nodeName),this.rootNode=e,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}static create(e,t,n){return e&&e.isAnimationObjectGroup?new i.Composite(e,t,n):new i(e,t,n)}static sanitizeNodeName(e){return e.replace(/\s/g,"_").replace(zv,"")}static parseTrackName(e){let t=qv.exec(e);if(t===null)throw new Error("THREE.PropertyBinding: Cannot parse trackName: "+e);let n={nodeName:t[2],objectName:t[3],objectIndex:t[4],propertyName:t[5],propertyIndex:t[6]},s=n.nodeName&&n.nodeName.lastIndexOf(".");if(s!==void 0&&s!==-1){let r=n.nodeName.substring(s+1);Yv.indexOf(r)!==-1&&(n.nodeName=n.nodeName.substring(0,s),n.objectName=r)}if(n.propertyName===null||n.propertyName.length===0)throw new Error("THREE.PropertyBinding: can not parse propertyName from trackName: "+e);return n}static findNode(e,t){if(t===void 0||t===""||t==="."||t===-1||t===e.name||t===e.uuid)return e;if(e.skeleton){let n=e.skeleton.getBoneByName(t);if(n!==void 0)return n}if(e.children){let n=function(r){for(let o=0;o<r.length;o++){let a=r[o];if(a.name===t||a.uuid===t)return a;let l=n(a.children);if(l)return l}return null},s=n(e.children);if(s)return s}return null}_getValue_unavailable(){}_setValue_unavailable(){}_getValue_direct(e,t){e[t]=this.targetObject[this.propertyName]}_getValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)e[t++]=n[s]}_getValue_arrayElement(e,t){e[t]=this.resolvedProperty[this.propertyIndex]}_getValue_toArray(e,t){this.resolvedProperty.toArray(e,t)}_setValue_direct(e,t){this.targetObject[this.propertyName]=e[t]}_setValue_direct_setNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.needsUpdate=!0}_setValue_direct_setMatrixWorldNeedsUpdate(e,t){this.targetObject[this.propertyName]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_array(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++]}_setValue_array_setNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.needsUpdate=!0}_setValue_array_setMatrixWorldNeedsUpdate(e,t){let n=this.resolvedProperty;for(let s=0,r=n.length;s!==r;++s)n[s]=e[t++];this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_arrayElement(e,t){this.resolvedProperty[this.propertyIndex]=e[t]}_setValue_arrayElement_setNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.needsUpdate=!0}_setValue_arrayElement_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty[this.propertyIndex]=e[t],this.targetObject.matrixWorldNeedsUpdate=!0}_setValue_fromArray(e,t){this.resolvedProperty.fromArray(e,t)}_setValue_fromArray_setNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.needsUpdate=!0}_setValue_fromArray_setMatrixWorldNeedsUpdate(e,t){this.resolvedProperty.fromArray(e,t),this.targetObject.matrixWorldNeedsUpdate=!0}_getValue_unbound(e,t){this.bind(),this.getValue(e,t)}_setValue_unbound(e,t){this.bind(),this.setValue(e,t)}bind(){let e=this.node,t=this.parsedPath,n=t.objectName,s=t.propertyName,r=t.propertyIndex;if(e||(e=i.findNode(this.rootNode,t.nodeName),this.node=e),this.getValue=this._getValue_unavailable,this.setValue=this._setValue_unavailable,!e){tt("PropertyBinding: No target node found for track: "+this.path+".");return}if(n){let c=t.objectIndex;switch(n){case"materials":if(!e.material){at("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.materials){at("PropertyBinding: Can not bind to material.materials as node.material does not have a materials array.",this);return}e=e.material.materials;break;case"bones":if(!e.skeleton){at("PropertyBinding: Can not bind to bones as node does not have a skeleton.",this);return}e=e.skeleton.bones;for(let h=0;h<e.length;h++)if(e[h].name===c){c=h;break}break;case"map":if("map"in e){e=e.map;break}if(!e.material){at("PropertyBinding: Can not bind to material as node does not have a material.",this);return}if(!e.material.map){at("PropertyBinding: Can not bind to material.map as node.material does not have a map.",this);return}e=e.material.map;break;default:if(e[n]===void 0){at("PropertyBinding: Can not bind to objectName of node undefined.",this);return}e=e[n]}if(c!==void 0){if(e[c]===void 0){at("PropertyBinding: Trying to bind to objectIndex of objectName, but is undefined.",this,e);return}e=e[c]}}let o=e[s];if(o===void 0){let c=t.nodeName;at("PropertyBinding: Trying to update property for track: "+c+"."+s+" but it wasn't found.",e);return}let a=this.Versioning.None;this.targetObject=e,e.isMaterial===!0?a=this.Versioning.NeedsUpdate:e.isObject3D===!0&&(a=this.Versioning.MatrixWorldNeedsUpdate);let l=this.BindingType.Direct;if(r!==void 0){if(s==="morphTargetInfluences"){if(!e.geometry){at("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.",this);return}if(!e.geometry.morphAttributes){at("PropertyBinding: Can not bind to morphTargetInfluences because node does not have a geometry.morphAttributes.",this);return}e.morphTargetDictionary[r]!==void 0&&(r=e.morphTargetDictionary[r])}l=this.BindingType.ArrayElement,this.resolvedProperty=o,this.propertyIndex=r}else o.fromArray!==void 0&&o.toArray!==void 0?(l=this.BindingType.HasFromToArray,this.resolvedProperty=o):Array.isArray(o)?(l=this.BindingType.EntireArray,this.resolvedProperty=o):this.propertyName=s;this.getValue=this.GetterByBindingType[l],this.setValue=this.SetterByBindingTypeAndVersioning[l][a]}unbind(){this.node=null,this.getValue=this._getValue_unbound,this.setValue=this._setValue_unbound}};Zt.Composite=sd;Zt.prototype.BindingType={Direct:0,EntireArray:1,ArrayElement:2,HasFromToArray:3};Zt.prototype.Versioning={None:0,NeedsUpdate:1,MatrixWorldNeedsUpdate:2};Zt.prototype.GetterByBindingType=[Zt.prototype._getValue_direct,Zt.prototype._getValue_array,Zt.prototype._getValue_arrayElement,Zt.prototype._getValue_toArray];Zt.prototype.SetterByBindingTypeAndVersioning=[[Zt.prototype._setValue_direct,Zt.prototype._setValue_direct_setNeedsUpdate,Zt.prototype._setValue_direct_setMatrixWorldNeedsUpdate],[Zt.prototype._setValue_array,Zt.prototype._setValue_array_setNeedsUpdate,Zt.prototype._setValue_array_setMatrixWorldNeedsUpdate],[Zt.prototype._setValue_arrayElement,Zt.prototype._setValue_arrayElement_setNeedsUpdate,Zt.prototype._setValue_arrayElement_setMatrixWorldNeedsUpdate],[Zt.prototype._setValue_fromArray,Zt.prototype._setValue_fromArray_setNeedsUpdate,Zt.prototype._setValue_fromArray_setMatrixWorldNeedsUpdate]];var JT=new Float32Array(1);var Gd=class Gd{constructor(e,t,n,s){this.elements=[1,0,0,1],e!==void 0&&this.set(e,t,n,s)}identity(){return this.set(1,0,0,1),this}fromArray(e,t=0){for(let n=0;n<4;n++)this.elements[n]=e[n+t];return this}set(e,t,n,s){let r=this.elements;return r[0]=e,r[2]=t,r[1]=n,r[3]=s,this}};Gd.prototype.isMatrix2=!0;var rd=Gd;function Od(i,e,t,n){let s=$v(n);switch(t){case wd:return i*e;case Td:return i*e/s.components*s.byteLength;case Uc:return i*e/s.components*s.byteLength;case Gs:return i*e*2/s.components*s.byteLength;case Fc:return i*e*2/s.components*s.byteLength;case Ed:return i*e*3/s.components*s.byteLength;case Li:return i*e*4/s.components*s.byteLength;case Oc:return i*e*4/s.components*s.byteLength;case Ua:case Fa:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Oa:case Ba:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case kc:case Hc:return Math.max(i,16)*Math.max(e,8)/4;case Bc:case zc:return Math.max(i,8)*Math.max(e,8)/2;case Gc:case Vc:case Xc:case qc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*8;case Wc:case ka:case Yc:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case $c:return Math.floor((i+3)/4)*Math.floor((e+3)/4)*16;case Zc:return Math.floor((i+4)/5)*Math.floor((e+3)/4)*16;case Jc:return Math.floor((i+4)/5)*Math.floor((e+4)/5)*16;case Kc:return Math.floor((i+5)/6)*Math.floor((e+4)/5)*16;case Qc:return Math.floor((i+5)/6)*Math.floor((e+5)/6)*16;case jc:return Math.floor((i+7)/8)*Math.floor((e+4)/5)*16;case eh:return Math.floor((i+7)/8)*Math.floor((e+5)/6)*16;case th:return Math.floor((i+7)/8)*Math.floor((e+7)/8)*16;case nh:return Math.floor((i+9)/10)*Math.floor((e+4)/5)*16;case ih:return Math.floor((i+9)/10)*Math.floor((e+5)/6)*16;case sh:return Math.floor((i+9)/10)*Math.floor((e+7)/8)*16;case rh:return Math.floor((i+9)/10)*Math.floor((e+9)/10)*16;case oh:return Math.floor((i+11)/12)*Math.floor((e+9)/10)*16;case ah:return Math.floor((i+11)/12)*Math.floor((e+11)/12)*16;case lh:case ch:case hh:return Math.ceil(i/4)*Math.ceil(e/4)*16;case uh:case dh:return Math.ceil(i/4)*Math.ceil(e/4)*8;case za:case fh:return Math.ceil(i/4)*Math.ceil(e/4)*16}throw new Error(`Unable to determine texture byte length for ${t} format.`)}function $v(i){switch(i){case jn:case yd:return{byteLength:1,components:1};case vo:case Sd:case Ii:return{byteLength:2,components:1};case Dc:case Nc:return{byteLength:2,components:4};case Ci:case Lc:case Pi:return{byteLength:4,components:1};case Md:case bd:return{byteLength:4,components:3}}throw new Error(`THREE.TextureUtils: Unknown texture type ${i}.`)}typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("register",{detail:{revision:"187"}}));typeof window<"u"&&(window.__THREE__?tt("WARNING: Multiple instances of Three.js being imported."):window.__THREE__="187");function vg(){let i=null,e=!1,t=null,n=null;function s(r,o){n=i.requestAnimationFrame(s),t(r,o)}return{start:function(){e!==!0&&t!==null&&i!==null&&(n=i.requestAnimationFrame(s),e=!0)},stop:function(){i!==null&&i.cancelAnimationFrame(n),e=!1},setAnimationLoop:function(r){t=r},setContext:function(r){i=r}}}function tx(i){let e=new WeakMap;function t(a,l){let c=a.array,h=a.usage,d=c.byteLength,u=i.createBuffer();i.bindBuffer(l,u),i.bufferData(l,c,h),a.onUploadCallback();let f;if(c instanceof Float32Array)f=i.FLOAT;else if(typeof Float16Array<"u"&&c instanceof Float16Array)f=i.HALF_FLOAT;else if(c instanceof Uint16Array)a.isFloat16BufferAttribute?f=i.HALF_FLOAT:f=i.UNSIGNED_SHORT;else if(c instanceof Int16Array)f=i.SHORT;else if(c instanceof Uint32Array)f=i.UNSIGNED_INT;else if(c instanceof Int32Array)f=i.INT;else if(c instanceof Int8Array)f=i.BYTE;else if(c instanceof Uint8Array)f=i.UNSIGNED_BYTE;else if(c instanceof Uint8ClampedArray)f=i.UNSIGNED_BYTE;else throw new Error("THREE.WebGLAttributes: Unsupported buffer data format: "+c);return{buffer:u,type:f,bytesPerElement:c.BYTES_PER_ELEMENT,version:a.version,size:d}}function n(a,l,c){let h=l.array,d=l.updateRanges;if(i.bindBuffer(c,a),d.length===0)i.bufferSubData(c,0,h);else{d.sort((f,p)=>f.start-p.start);let u=0;for(let f=1;f<d.length;f++){let p=d[u],x=d[f];x.start<=p.start+p.count+1?p.count=Math.max(p.count,x.start+x.count-p.start):(++u,d[u]=x)}d.length=u+1;for(let f=0,p=d.length;f<p;f++){let x=d[f];i.bufferSubData(c,x.start*h.BYTES_PER_ELEMENT,h,x.start,x.count)}l.clearUpdateRanges()}l.onUploadCallback()}function s(a){return a.isInterleavedBufferAttribute&&(a=a.data),e.get(a)}function r(a){a.isInterleavedBufferAttribute&&(a=a.data);let l=e.get(a);l&&(i.deleteBuffer(l.buffer),e.delete(a))}function o(a,l){if(a.isInterleavedBufferAttribute&&(a=a.data),a.isGLBufferAttribute){let h=e.get(a);(!h||h.version<a.version)&&e.set(a,{buffer:a.buffer,type:a.type,bytesPerElement:a.elementSize,version:a.version});return}let c=e.get(a);if(c===void 0)e.set(a,t(a,l));else if(c.version<a.version){if(c.size!==a.array.byteLength)throw new Error("THREE.WebGLAttributes: The size of the buffer attribute's array buffer does not match the original size. Resizing buffer attributes is not supported.");n(c.buffer,a,l),c.version=a.version}}return{get:s,remove:r,update:o}}var nx=`#ifdef USE_ALPHAHASH
	if ( diffuseColor.a < getAlphaHashThreshold( vPosition ) ) discard;
#endif`,ix=`#ifdef USE_ALPHAHASH
	const float ALPHA_HASH_SCALE = 0.05;
	float hash2D( vec2 value ) {
		return fract( 1.0e4 * sin( 17.0 * value.x + 0.1 * value.y ) * ( 0.1 + abs( sin( 13.0 * value.y + value.x ) ) ) );
	}
	float hash3D( vec3 value ) {
		return hash2D( vec2( hash2D( value.xy ), value.z ) );
	}
	float getAlphaHashThreshold( vec3 position ) {
		float maxDeriv = max(
			length( dFdx( position.xyz ) ),
			length( dFdy( position.xyz ) )
		);
		float pixScale = 1.0 / ( ALPHA_HASH_SCALE * maxDeriv );
		vec2 pixScales = vec2(
			exp2( floor( log2( pixScale ) ) ),
			exp2( ceil( log2( pixScale ) ) )
		);
		vec2 alpha = vec2(
			hash3D( floor( pixScales.x * position.xyz ) ),
			hash3D( floor( pixScales.y * position.xyz ) )
		);
		float lerpFactor = fract( log2( pixScale ) );
		float x = ( 1.0 - lerpFactor ) * alpha.x + lerpFactor * alpha.y;
		float a = min( lerpFactor, 1.0 - lerpFactor );
		vec3 cases = vec3(
			x * x / ( 2.0 * a * ( 1.0 - a ) ),
			( x - 0.5 * a ) / ( 1.0 - a ),
			1.0 - ( ( 1.0 - x ) * ( 1.0 - x ) / ( 2.0 * a * ( 1.0 - a ) ) )
		);
		float threshold = ( x < ( 1.0 - a ) )
			? ( ( x < a ) ? cases.x : cases.y )
			: cases.z;
		return clamp( threshold , 1.0e-6, 1.0 );
	}
#endif`,sx=`#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, vAlphaMapUv ).g;
#endif`,rx=`#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,ox=`#ifdef USE_ALPHATEST
	#ifdef ALPHA_TO_COVERAGE
	diffuseColor.a = smoothstep( alphaTest, alphaTest + fwidth( diffuseColor.a ), diffuseColor.a );
	if ( diffuseColor.a == 0.0 ) discard;
	#else
	if ( diffuseColor.a < alphaTest ) discard;
	#endif
#endif`,ax=`#ifdef USE_ALPHATEST
	uniform float alphaTest;
#endif`,lx=`#ifdef USE_AOMAP
	float ambientOcclusion = ( texture2D( aoMap, vAoMapUv ).r - 1.0 ) * aoMapIntensity + 1.0;
	reflectedLight.indirectDiffuse *= ambientOcclusion;
	#if defined( USE_CLEARCOAT ) 
		clearcoatSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_SHEEN ) 
		sheenSpecularIndirect *= ambientOcclusion;
	#endif
	#if defined( USE_ENVMAP ) && defined( STANDARD )
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		reflectedLight.indirectSpecular *= computeSpecularOcclusion( dotNV, ambientOcclusion, material.roughness );
	#endif
#endif`,cx=`#ifdef USE_AOMAP
	uniform sampler2D aoMap;
	uniform float aoMapIntensity;
#endif`,hx=`#ifdef USE_BATCHING
	#if ! defined( GL_ANGLE_multi_draw )
	#define gl_DrawID _gl_DrawID
	uniform int _gl_DrawID;
	#endif
	uniform highp sampler2D batchingTexture;
	uniform highp usampler2D batchingIdTexture;
	mat4 getBatchingMatrix( const in float i ) {
		int size = textureSize( batchingTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( batchingTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( batchingTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( batchingTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( batchingTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
	float getIndirectIndex( const in int i ) {
		int size = textureSize( batchingIdTexture, 0 ).x;
		int x = i % size;
		int y = i / size;
		return float( texelFetch( batchingIdTexture, ivec2( x, y ), 0 ).r );
	}
#endif
#ifdef USE_BATCHING_COLOR
	uniform sampler2D batchingColorTexture;
	vec4 getBatchingColor( const in float i ) {
		int size = textureSize( batchingColorTexture, 0 ).x;
		int j = int( i );
		int x = j % size;
		int y = j / size;
		return texelFetch( batchingColorTexture, ivec2( x, y ), 0 );
	}
#endif`,ux=`#ifdef USE_BATCHING
	mat4 batchingMatrix = getBatchingMatrix( getIndirectIndex( gl_DrawID ) );
#endif`,dx=`vec3 transformed = vec3( position );
#ifdef USE_ALPHAHASH
	vPosition = vec3( position );
#endif`,fx=`vec3 objectNormal = vec3( normal );
#ifdef USE_TANGENT
	vec3 objectTangent = vec3( tangent.xyz );
#endif`,px=`float G_BlinnPhong_Implicit( ) {
	return 0.25;
}
float D_BlinnPhong( const in float shininess, const in float dotNH ) {
	return RECIPROCAL_PI * ( shininess * 0.5 + 1.0 ) * pow( dotNH, shininess );
}
vec3 BRDF_BlinnPhong( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 specularColor, const in float shininess ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( specularColor, 1.0, dotVH );
	float G = G_BlinnPhong_Implicit( );
	float D = D_BlinnPhong( shininess, dotNH );
	return F * ( G * D );
} // validated`,mx=`#ifdef USE_IRIDESCENCE
	const mat3 XYZ_TO_REC709 = mat3(
		 3.2404542, -0.9692660,  0.0556434,
		-1.5371385,  1.8760108, -0.2040259,
		-0.4985314,  0.0415560,  1.0572252
	);
	vec3 Fresnel0ToIor( vec3 fresnel0 ) {
		vec3 sqrtF0 = sqrt( fresnel0 );
		return ( vec3( 1.0 ) + sqrtF0 ) / ( vec3( 1.0 ) - sqrtF0 );
	}
	vec3 IorToFresnel0( vec3 transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - vec3( incidentIor ) ) / ( transmittedIor + vec3( incidentIor ) ) );
	}
	float IorToFresnel0( float transmittedIor, float incidentIor ) {
		return pow2( ( transmittedIor - incidentIor ) / ( transmittedIor + incidentIor ));
	}
	vec3 evalSensitivity( float OPD, vec3 shift ) {
		float phase = 2.0 * PI * OPD * 1.0e-9;
		vec3 val = vec3( 5.4856e-13, 4.4201e-13, 5.2481e-13 );
		vec3 pos = vec3( 1.6810e+06, 1.7953e+06, 2.2084e+06 );
		vec3 var = vec3( 4.3278e+09, 9.3046e+09, 6.6121e+09 );
		vec3 xyz = val * sqrt( 2.0 * PI * var ) * cos( pos * phase + shift ) * exp( - pow2( phase ) * var );
		xyz.x += 9.7470e-14 * sqrt( 2.0 * PI * 4.5282e+09 ) * cos( 2.2399e+06 * phase + shift[ 0 ] ) * exp( - 4.5282e+09 * pow2( phase ) );
		xyz /= 1.0685e-7;
		vec3 rgb = XYZ_TO_REC709 * xyz;
		return rgb;
	}
	vec3 evalIridescence( float outsideIOR, float eta2, float cosTheta1, float thinFilmThickness, vec3 baseF0 ) {
		vec3 I;
		float iridescenceIOR = mix( outsideIOR, eta2, smoothstep( 0.0, 0.03, thinFilmThickness ) );
		float sinTheta2Sq = pow2( outsideIOR / iridescenceIOR ) * ( 1.0 - pow2( cosTheta1 ) );
		float cosTheta2Sq = 1.0 - sinTheta2Sq;
		if ( cosTheta2Sq < 0.0 ) {
			return vec3( 1.0 );
		}
		float cosTheta2 = sqrt( cosTheta2Sq );
		float R0 = IorToFresnel0( iridescenceIOR, outsideIOR );
		float R12 = F_Schlick( R0, 1.0, cosTheta1 );
		float T121 = 1.0 - R12;
		float phi12 = 0.0;
		if ( iridescenceIOR < outsideIOR ) phi12 = PI;
		float phi21 = PI - phi12;
		vec3 baseIOR = Fresnel0ToIor( clamp( baseF0, 0.0, 0.9999 ) );		vec3 R1 = IorToFresnel0( baseIOR, iridescenceIOR );
		vec3 R23 = F_Schlick( R1, 1.0, cosTheta2 );
		vec3 phi23 = vec3( 0.0 );
		if ( baseIOR[ 0 ] < iridescenceIOR ) phi23[ 0 ] = PI;
		if ( baseIOR[ 1 ] < iridescenceIOR ) phi23[ 1 ] = PI;
		if ( baseIOR[ 2 ] < iridescenceIOR ) phi23[ 2 ] = PI;
		float OPD = 2.0 * iridescenceIOR * thinFilmThickness * cosTheta2;
		vec3 phi = vec3( phi21 ) + phi23;
		vec3 R123 = clamp( R12 * R23, 1e-5, 0.9999 );
		vec3 r123 = sqrt( R123 );
		vec3 Rs = pow2( T121 ) * R23 / ( vec3( 1.0 ) - R123 );
		vec3 C0 = R12 + Rs;
		I = C0;
		vec3 Cm = Rs - T121;
		for ( int m = 1; m <= 2; ++ m ) {
			Cm *= r123;
			vec3 Sm = 2.0 * evalSensitivity( float( m ) * OPD, float( m ) * phi );
			I += Cm * Sm;
		}
		return max( I, vec3( 0.0 ) );
	}
#endif`,gx=`#ifdef USE_BUMPMAP
	uniform sampler2D bumpMap;
	uniform float bumpScale;
	vec2 dHdxy_fwd() {
		vec2 dSTdx = dFdx( vBumpMapUv );
		vec2 dSTdy = dFdy( vBumpMapUv );
		float Hll = bumpScale * texture2D( bumpMap, vBumpMapUv ).x;
		float dBx = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdx ).x - Hll;
		float dBy = bumpScale * texture2D( bumpMap, vBumpMapUv + dSTdy ).x - Hll;
		return vec2( dBx, dBy );
	}
	vec3 perturbNormalArb( vec3 surf_pos, vec3 surf_norm, vec2 dHdxy, float faceDirection ) {
		vec3 vSigmaX = normalize( dFdx( surf_pos.xyz ) );
		vec3 vSigmaY = normalize( dFdy( surf_pos.xyz ) );
		vec3 vN = surf_norm;
		vec3 R1 = cross( vSigmaY, vN );
		vec3 R2 = cross( vN, vSigmaX );
		float fDet = dot( vSigmaX, R1 ) * faceDirection;
		vec3 vGrad = sign( fDet ) * ( dHdxy.x * R1 + dHdxy.y * R2 );
		return normalize( abs( fDet ) * surf_norm - vGrad );
	}
#endif`,_x=`#if NUM_CLIPPING_PLANES > 0
	vec4 plane;
	#ifdef ALPHA_TO_COVERAGE
		float distanceToPlane, distanceGradient;
		float clipOpacity = 1.0;
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
			distanceGradient = fwidth( distanceToPlane ) / 2.0;
			clipOpacity *= smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			if ( clipOpacity == 0.0 ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			float unionClipOpacity = 1.0;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				distanceToPlane = - dot( vClipPosition, plane.xyz ) + plane.w;
				distanceGradient = fwidth( distanceToPlane ) / 2.0;
				unionClipOpacity *= 1.0 - smoothstep( - distanceGradient, distanceGradient, distanceToPlane );
			}
			#pragma unroll_loop_end
			clipOpacity *= 1.0 - unionClipOpacity;
		#endif
		diffuseColor.a *= clipOpacity;
		if ( diffuseColor.a == 0.0 ) discard;
	#else
		#pragma unroll_loop_start
		for ( int i = 0; i < UNION_CLIPPING_PLANES; i ++ ) {
			plane = clippingPlanes[ i ];
			if ( dot( vClipPosition, plane.xyz ) > plane.w ) discard;
		}
		#pragma unroll_loop_end
		#if UNION_CLIPPING_PLANES < NUM_CLIPPING_PLANES
			bool clipped = true;
			#pragma unroll_loop_start
			for ( int i = UNION_CLIPPING_PLANES; i < NUM_CLIPPING_PLANES; i ++ ) {
				plane = clippingPlanes[ i ];
				clipped = ( dot( vClipPosition, plane.xyz ) > plane.w ) && clipped;
			}
			#pragma unroll_loop_end
			if ( clipped ) discard;
		#endif
	#endif
#endif`,vx=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
	uniform vec4 clippingPlanes[ NUM_CLIPPING_PLANES ];
#endif`,xx=`#if NUM_CLIPPING_PLANES > 0
	varying vec3 vClipPosition;
#endif`,yx=`#if NUM_CLIPPING_PLANES > 0
	vClipPosition = - mvPosition.xyz;
#endif`,Sx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	diffuseColor *= vColor;
#endif`,Mx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA )
	varying vec4 vColor;
#endif`,bx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	varying vec4 vColor;
#endif`,wx=`#if defined( USE_COLOR ) || defined( USE_COLOR_ALPHA ) || defined( USE_INSTANCING_COLOR ) || defined( USE_BATCHING_COLOR )
	vColor = vec4( 1.0 );
#endif
#ifdef USE_COLOR_ALPHA
	vColor *= color;
#elif defined( USE_COLOR )
	vColor.rgb *= color;
#endif
#ifdef USE_INSTANCING_COLOR
	vColor.rgb *= instanceColor.rgb;
#endif
#ifdef USE_BATCHING_COLOR
	vColor *= getBatchingColor( getIndirectIndex( gl_DrawID ) );
#endif`,Ex=`#define PI 3.141592653589793
#define PI2 6.283185307179586
#define PI_HALF 1.5707963267948966
#define RECIPROCAL_PI 0.3183098861837907
#define RECIPROCAL_PI2 0.15915494309189535
#define EPSILON 1e-6
#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
#define whiteComplement( a ) ( 1.0 - saturate( a ) )
float pow2( const in float x ) { return x*x; }
vec3 pow2( const in vec3 x ) { return x*x; }
float pow3( const in float x ) { return x*x*x; }
float pow4( const in float x ) { float x2 = x*x; return x2*x2; }
float max3( const in vec3 v ) { return max( max( v.x, v.y ), v.z ); }
float average( const in vec3 v ) { return dot( v, vec3( 0.3333333 ) ); }
highp float rand( const in vec2 uv ) {
	const highp float a = 12.9898, b = 78.233, c = 43758.5453;
	highp float dt = dot( uv.xy, vec2( a,b ) ), sn = mod( dt, PI );
	return fract( sin( sn ) * c );
}
#ifdef HIGH_PRECISION
	float precisionSafeLength( vec3 v ) { return length( v ); }
#else
	float precisionSafeLength( vec3 v ) {
		float maxComponent = max3( abs( v ) );
		return length( v / maxComponent ) * maxComponent;
	}
#endif
struct IncidentLight {
	vec3 color;
	vec3 direction;
	bool visible;
};
struct ReflectedLight {
	vec3 directDiffuse;
	vec3 directSpecular;
	vec3 indirectDiffuse;
	vec3 indirectSpecular;
};
#ifdef USE_ALPHAHASH
	varying vec3 vPosition;
#endif
vec3 transformDirection( in vec3 dir, in mat4 matrix ) {
	return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );
}
#define inverseTransformDirection transformDirectionByInverseViewMatrix
vec3 transformNormalByInverseViewMatrix( in vec3 normal, in mat4 viewMatrix ) {
	return normalize( ( vec4( normal, 0.0 ) * viewMatrix ).xyz );
}
vec3 transformDirectionByInverseViewMatrix( in vec3 dir, in mat4 viewMatrix ) {
	return normalize( ( vec4( dir, 0.0 ) * viewMatrix ).xyz );
}
bool isPerspectiveMatrix( mat4 m ) {
	return m[ 2 ][ 3 ] == - 1.0;
}
vec2 equirectUv( in vec3 dir ) {
	float u = atan( dir.z, dir.x ) * RECIPROCAL_PI2 + 0.5;
	float v = asin( clamp( dir.y, - 1.0, 1.0 ) ) * RECIPROCAL_PI + 0.5;
	return vec2( u, v );
}
vec3 BRDF_Lambert( const in vec3 diffuseColor ) {
	return RECIPROCAL_PI * diffuseColor;
}
vec3 F_Schlick( const in vec3 f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
}
float F_Schlick( const in float f0, const in float f90, const in float dotVH ) {
	float fresnel = exp2( ( - 5.55473 * dotVH - 6.98316 ) * dotVH );
	return f0 * ( 1.0 - fresnel ) + ( f90 * fresnel );
} // validated`,Tx=`vec3 transformedNormal = objectNormal;
#ifdef USE_TANGENT
	vec3 transformedTangent = objectTangent;
#endif
#ifdef USE_BATCHING
	mat3 bm = mat3( batchingMatrix );
	transformedNormal /= vec3( dot( bm[ 0 ], bm[ 0 ] ), dot( bm[ 1 ], bm[ 1 ] ), dot( bm[ 2 ], bm[ 2 ] ) );
	transformedNormal = bm * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = bm * transformedTangent;
	#endif
#endif
#ifdef USE_INSTANCING
	mat3 im = mat3( instanceMatrix );
	transformedNormal /= vec3( dot( im[ 0 ], im[ 0 ] ), dot( im[ 1 ], im[ 1 ] ), dot( im[ 2 ], im[ 2 ] ) );
	transformedNormal = im * transformedNormal;
	#ifdef USE_TANGENT
		transformedTangent = im * transformedTangent;
	#endif
#endif
transformedNormal = normalMatrix * transformedNormal;
#ifdef FLIP_SIDED
	transformedNormal = - transformedNormal;
#endif
#ifdef USE_TANGENT
	transformedTangent = ( modelViewMatrix * vec4( transformedTangent, 0.0 ) ).xyz;
#endif`,Ax=`#ifdef USE_DISPLACEMENTMAP
	uniform sampler2D displacementMap;
	uniform float displacementScale;
	uniform float displacementBias;
#endif`,Rx=`#ifdef USE_DISPLACEMENTMAP
	transformed += normalize( objectNormal ) * ( texture2D( displacementMap, vDisplacementMapUv ).x * displacementScale + displacementBias );
#endif`,Cx=`#ifdef USE_EMISSIVEMAP
	vec4 emissiveColor = texture2D( emissiveMap, vEmissiveMapUv );
	#ifdef DECODE_VIDEO_TEXTURE_EMISSIVE
		emissiveColor = sRGBTransferEOTF( emissiveColor );
	#endif
	totalEmissiveRadiance *= emissiveColor.rgb;
#endif`,Px=`#ifdef USE_EMISSIVEMAP
	uniform sampler2D emissiveMap;
#endif`,Ix="gl_FragColor = linearToOutputTexel( gl_FragColor );",Lx=`vec4 LinearTransferOETF( in vec4 value ) {
	return value;
}
vec4 sRGBTransferEOTF( in vec4 value ) {
	return vec4( mix( pow( value.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), value.rgb * 0.0773993808, vec3( lessThanEqual( value.rgb, vec3( 0.04045 ) ) ) ), value.a );
}
vec4 sRGBTransferOETF( in vec4 value ) {
	return vec4( mix( pow( value.rgb, vec3( 0.41666 ) ) * 1.055 - vec3( 0.055 ), value.rgb * 12.92, vec3( lessThanEqual( value.rgb, vec3( 0.0031308 ) ) ) ), value.a );
}`,Dx=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vec3 cameraToFrag;
		if ( isOrthographic ) {
			cameraToFrag = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToFrag = normalize( vWorldPosition - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vec3 reflectVec = reflect( cameraToFrag, worldNormal );
		#else
			vec3 reflectVec = refract( cameraToFrag, worldNormal, refractionRatio );
		#endif
	#else
		vec3 reflectVec = vReflect;
	#endif
	#ifdef ENVMAP_TYPE_CUBE
		vec4 envColor = textureCube( envMap, envMapRotation * reflectVec );
		#ifdef ENVMAP_BLENDING_MULTIPLY
			outgoingLight = mix( outgoingLight, outgoingLight * envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_MIX )
			outgoingLight = mix( outgoingLight, envColor.xyz, specularStrength * reflectivity );
		#elif defined( ENVMAP_BLENDING_ADD )
			outgoingLight += envColor.xyz * specularStrength * reflectivity;
		#endif
	#endif
#endif`,Nx=`#ifdef USE_ENVMAP
	uniform float envMapIntensity;
	uniform mat3 envMapRotation;
	uniform samplerCube envMap;
	#ifdef ENVMAP_TYPE_PMREM
		float roughnessToMip( const in float roughness ) {
			float r = clamp( roughness, 0.0, 1.0 );
			return ENVMAP_MAX_LOD * r * ( 2.0 - r );
		}
	#endif
#endif`,Ux=`#ifdef USE_ENVMAP
	uniform float reflectivity;
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		varying vec3 vWorldPosition;
		uniform float refractionRatio;
	#else
		varying vec3 vReflect;
	#endif
#endif`,Fx=`#ifdef USE_ENVMAP
	#if defined( USE_BUMPMAP ) || defined( USE_NORMALMAP ) || defined( PHONG ) || defined( LAMBERT )
		#define ENV_WORLDPOS
	#endif
	#ifdef ENV_WORLDPOS
		
		varying vec3 vWorldPosition;
	#else
		varying vec3 vReflect;
		uniform float refractionRatio;
	#endif
#endif`,Ox=`#ifdef USE_ENVMAP
	#ifdef ENV_WORLDPOS
		vWorldPosition = worldPosition.xyz;
	#else
		vec3 cameraToVertex;
		if ( isOrthographic ) {
			cameraToVertex = normalize( vec3( - viewMatrix[ 0 ][ 2 ], - viewMatrix[ 1 ][ 2 ], - viewMatrix[ 2 ][ 2 ] ) );
		} else {
			cameraToVertex = normalize( worldPosition.xyz - cameraPosition );
		}
		vec3 worldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
		#ifdef ENVMAP_MODE_REFLECTION
			vReflect = reflect( cameraToVertex, worldNormal );
		#else
			vReflect = refract( cameraToVertex, worldNormal, refractionRatio );
		#endif
	#endif
#endif`,Bx=`#ifdef USE_FOG
	vFogDepth = - mvPosition.z;
#endif`,kx=`#ifdef USE_FOG
	varying float vFogDepth;
#endif`,zx=`#ifdef USE_FOG
	#ifdef FOG_EXP2
		float fogFactor = 1.0 - exp( - fogDensity * fogDensity * vFogDepth * vFogDepth );
	#else
		float fogFactor = smoothstep( fogNear, fogFar, vFogDepth );
	#endif
	gl_FragColor.rgb = mix( gl_FragColor.rgb, fogColor, fogFactor );
#endif`,Hx=`#ifdef USE_FOG
	uniform vec3 fogColor;
	varying float vFogDepth;
	#ifdef FOG_EXP2
		uniform float fogDensity;
	#else
		uniform float fogNear;
		uniform float fogFar;
	#endif
#endif`,Gx=`#ifdef USE_GRADIENTMAP
	uniform sampler2D gradientMap;
#endif
vec3 getGradientIrradiance( vec3 normal, vec3 lightDirection ) {
	float dotNL = dot( normal, lightDirection );
	vec2 coord = vec2( dotNL * 0.5 + 0.5, 0.0 );
	#ifdef USE_GRADIENTMAP
		return vec3( texture2D( gradientMap, coord ).r );
	#else
		vec2 fw = fwidth( coord ) * 0.5;
		return mix( vec3( 0.7 ), vec3( 1.0 ), smoothstep( 0.7 - fw.x, 0.7 + fw.x, coord.x ) );
	#endif
}`,Vx=`#ifdef USE_LIGHTMAP
	uniform sampler2D lightMap;
	uniform float lightMapIntensity;
#endif`,Wx=`LambertMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularStrength = specularStrength;`,Xx=`varying vec3 vViewPosition;
struct LambertMaterial {
	vec3 diffuseColor;
	float specularStrength;
};
void RE_Direct_Lambert( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Lambert( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in LambertMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Lambert
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Lambert`,qx=`uniform bool receiveShadow;
uniform vec3 ambientLightColor;
#if defined( USE_LIGHT_PROBES )
	uniform vec3 lightProbe[ 9 ];
#endif
vec3 shGetIrradianceAt( in vec3 normal, in vec3 shCoefficients[ 9 ] ) {
	float x = normal.x, y = normal.y, z = normal.z;
	vec3 result = shCoefficients[ 0 ] * 0.886227;
	result += shCoefficients[ 1 ] * 2.0 * 0.511664 * y;
	result += shCoefficients[ 2 ] * 2.0 * 0.511664 * z;
	result += shCoefficients[ 3 ] * 2.0 * 0.511664 * x;
	result += shCoefficients[ 4 ] * 2.0 * 0.429043 * x * y;
	result += shCoefficients[ 5 ] * 2.0 * 0.429043 * y * z;
	result += shCoefficients[ 6 ] * ( 0.743125 * z * z - 0.247708 );
	result += shCoefficients[ 7 ] * 2.0 * 0.429043 * x * z;
	result += shCoefficients[ 8 ] * 0.429043 * ( x * x - y * y );
	return result;
}
vec3 getLightProbeIrradiance( const in vec3 lightProbe[ 9 ], const in vec3 normal ) {
	vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec3 irradiance = shGetIrradianceAt( worldNormal, lightProbe );
	return irradiance;
}
vec3 getAmbientLightIrradiance( const in vec3 ambientLightColor ) {
	vec3 irradiance = ambientLightColor;
	return irradiance;
}
float getDistanceAttenuation( const in float lightDistance, const in float cutoffDistance, const in float decayExponent ) {
	float distanceFalloff = 1.0 / max( pow( lightDistance, decayExponent ), 0.01 );
	if ( cutoffDistance > 0.0 ) {
		distanceFalloff *= pow2( saturate( 1.0 - pow4( lightDistance / cutoffDistance ) ) );
	}
	return distanceFalloff;
}
float getSpotAttenuation( const in float coneCosine, const in float penumbraCosine, const in float angleCosine ) {
	return smoothstep( coneCosine, penumbraCosine, angleCosine );
}
#if NUM_SUN_LIGHTS > 0
	struct SunLight {
		vec3 direction;
		vec3 color;
	};
	uniform SunLight sunLights[ NUM_SUN_LIGHTS ];
	void getSunLightInfo( const in SunLight sunLight, out IncidentLight light ) {
		light.color = sunLight.color;
		light.direction = sunLight.direction;
		light.visible = true;
	}
#endif
#if NUM_DIR_LIGHTS > 0
	struct DirectionalLight {
		vec3 direction;
		vec3 color;
	};
	uniform DirectionalLight directionalLights[ NUM_DIR_LIGHTS ];
	void getDirectionalLightInfo( const in DirectionalLight directionalLight, out IncidentLight light ) {
		light.color = directionalLight.color;
		light.direction = directionalLight.direction;
		light.visible = true;
	}
#endif
#if NUM_POINT_LIGHTS > 0
	struct PointLight {
		vec3 position;
		vec3 color;
		float distance;
		float decay;
	};
	uniform PointLight pointLights[ NUM_POINT_LIGHTS ];
	void getPointLightInfo( const in PointLight pointLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = pointLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float lightDistance = length( lVector );
		light.color = pointLight.color;
		light.color *= getDistanceAttenuation( lightDistance, pointLight.distance, pointLight.decay );
		light.visible = ( light.color != vec3( 0.0 ) );
	}
#endif
#if NUM_SPOT_LIGHTS > 0
	struct SpotLight {
		vec3 position;
		vec3 direction;
		vec3 color;
		float distance;
		float decay;
		float coneCos;
		float penumbraCos;
	};
	uniform SpotLight spotLights[ NUM_SPOT_LIGHTS ];
	void getSpotLightInfo( const in SpotLight spotLight, const in vec3 geometryPosition, out IncidentLight light ) {
		vec3 lVector = spotLight.position - geometryPosition;
		light.direction = normalize( lVector );
		float angleCos = dot( light.direction, spotLight.direction );
		float spotAttenuation = getSpotAttenuation( spotLight.coneCos, spotLight.penumbraCos, angleCos );
		if ( spotAttenuation > 0.0 ) {
			float lightDistance = length( lVector );
			light.color = spotLight.color * spotAttenuation;
			light.color *= getDistanceAttenuation( lightDistance, spotLight.distance, spotLight.decay );
			light.visible = ( light.color != vec3( 0.0 ) );
		} else {
			light.color = vec3( 0.0 );
			light.visible = false;
		}
	}
#endif
#if NUM_RECT_AREA_LIGHTS > 0
	struct RectAreaLight {
		vec3 color;
		vec3 position;
		vec3 halfWidth;
		vec3 halfHeight;
	};
	uniform sampler2D ltc_1;	uniform sampler2D ltc_2;
	uniform RectAreaLight rectAreaLights[ NUM_RECT_AREA_LIGHTS ];
#endif
#if NUM_HEMI_LIGHTS > 0
	struct HemisphereLight {
		vec3 direction;
		vec3 skyColor;
		vec3 groundColor;
	};
	uniform HemisphereLight hemisphereLights[ NUM_HEMI_LIGHTS ];
	vec3 getHemisphereLightIrradiance( const in HemisphereLight hemiLight, const in vec3 normal ) {
		float dotNL = dot( normal, hemiLight.direction );
		float hemiDiffuseWeight = 0.5 * dotNL + 0.5;
		vec3 irradiance = mix( hemiLight.groundColor, hemiLight.skyColor, hemiDiffuseWeight );
		return irradiance;
	}
#endif
#include <lightprobes_pars_fragment>`,Yx=`#ifdef USE_ENVMAP
	vec3 getIBLIrradiance( const in vec3 normal ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 worldNormal = transformNormalByInverseViewMatrix( normal, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * worldNormal, ENVMAP_MAX_LOD );
			return PI * envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	vec3 getIBLRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
		#ifdef ENVMAP_TYPE_PMREM
			vec3 reflectVec = reflect( - viewDir, normal );
			reflectVec = normalize( mix( reflectVec, normal, pow4( roughness ) ) );
			reflectVec = transformDirectionByInverseViewMatrix( reflectVec, viewMatrix );
			vec4 envMapColor = textureLod( envMap, envMapRotation * reflectVec, roughnessToMip( roughness ) );
			return envMapColor.rgb * envMapIntensity;
		#else
			return vec3( 0.0 );
		#endif
	}
	#ifdef USE_RETROREFLECTION
		vec3 getIBLRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 retroVec = normalize( mix( viewDir, normal, pow4( roughness ) ) );
				retroVec = transformDirectionByInverseViewMatrix( retroVec, viewMatrix );
				vec4 envMapColor = textureLod( envMap, envMapRotation * retroVec, roughnessToMip( roughness ) );
				return envMapColor.rgb * envMapIntensity;
			#else
				return vec3( 0.0 );
			#endif
		}
	#endif
	#ifdef USE_ANISOTROPY
		vec3 getIBLAnisotropyRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
			#ifdef ENVMAP_TYPE_PMREM
				vec3 bentNormal = cross( bitangent, viewDir );
				bentNormal = normalize( cross( bentNormal, bitangent ) );
				bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
				return getIBLRadiance( viewDir, bentNormal, roughness );
			#else
				return vec3( 0.0 );
			#endif
		}
		#ifdef USE_RETROREFLECTION
			vec3 getIBLAnisotropyRetroRadiance( const in vec3 viewDir, const in vec3 normal, const in float roughness, const in vec3 bitangent, const in float anisotropy ) {
				#ifdef ENVMAP_TYPE_PMREM
					vec3 bentNormal = cross( bitangent, viewDir );
					bentNormal = normalize( cross( bentNormal, bitangent ) );
					bentNormal = normalize( mix( bentNormal, normal, pow2( pow2( 1.0 - anisotropy * ( 1.0 - roughness ) ) ) ) );
					return getIBLRetroRadiance( viewDir, bentNormal, roughness );
				#else
					return vec3( 0.0 );
				#endif
			}
		#endif
	#endif
#endif`,$x=`ToonMaterial material;
material.diffuseColor = diffuseColor.rgb;`,Zx=`varying vec3 vViewPosition;
struct ToonMaterial {
	vec3 diffuseColor;
};
void RE_Direct_Toon( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 irradiance = getGradientIrradiance( geometryNormal, directLight.direction ) * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
void RE_IndirectDiffuse_Toon( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in ToonMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_Toon
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Toon`,Jx=`BlinnPhongMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.specularColor = specular;
material.specularShininess = shininess;
material.specularStrength = specularStrength;`,Kx=`varying vec3 vViewPosition;
struct BlinnPhongMaterial {
	vec3 diffuseColor;
	vec3 specularColor;
	float specularShininess;
	float specularStrength;
};
void RE_Direct_BlinnPhong( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	reflectedLight.directDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
	reflectedLight.directSpecular += irradiance * BRDF_BlinnPhong( directLight.direction, geometryViewDir, geometryNormal, material.specularColor, material.specularShininess ) * material.specularStrength;
}
void RE_IndirectDiffuse_BlinnPhong( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in BlinnPhongMaterial material, inout ReflectedLight reflectedLight ) {
	reflectedLight.indirectDiffuse += irradiance * BRDF_Lambert( material.diffuseColor );
}
#define RE_Direct				RE_Direct_BlinnPhong
#define RE_IndirectDiffuse		RE_IndirectDiffuse_BlinnPhong`,Qx=`PhysicalMaterial material;
material.diffuseColor = diffuseColor.rgb;
material.diffuseContribution = diffuseColor.rgb * ( 1.0 - metalnessFactor );
material.metalness = metalnessFactor;
vec3 dxy = max( abs( dFdx( nonPerturbedNormal ) ), abs( dFdy( nonPerturbedNormal ) ) );
float geometryRoughness = max( max( dxy.x, dxy.y ), dxy.z );
material.roughness = max( roughnessFactor, 0.045 );
material.roughness += geometryRoughness;
material.roughness = min( material.roughness, 1.0 );
#ifdef USE_DIFFUSE_ROUGHNESS
	float diffuseRoughnessFactor = diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		diffuseRoughnessFactor *= texture2D( diffuseRoughnessMap, vDiffuseRoughnessMapUv ).r;
	#endif
	material.diffuseRoughness = saturate( diffuseRoughnessFactor );
#endif
#ifdef IOR
	material.ior = ior;
	#ifdef USE_SPECULAR
		float specularIntensityFactor = specularIntensity;
		vec3 specularColorFactor = specularColor;
		#ifdef USE_SPECULAR_COLORMAP
			specularColorFactor *= texture2D( specularColorMap, vSpecularColorMapUv ).rgb;
		#endif
		#ifdef USE_SPECULAR_INTENSITYMAP
			specularIntensityFactor *= texture2D( specularIntensityMap, vSpecularIntensityMapUv ).a;
		#endif
		material.specularF90 = mix( specularIntensityFactor, 1.0, metalnessFactor );
	#else
		float specularIntensityFactor = 1.0;
		vec3 specularColorFactor = vec3( 1.0 );
		material.specularF90 = 1.0;
	#endif
	material.specularColor = min( pow2( ( material.ior - 1.0 ) / ( material.ior + 1.0 ) ) * specularColorFactor, vec3( 1.0 ) ) * specularIntensityFactor;
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
#else
	material.specularColor = vec3( 0.04 );
	material.specularColorBlended = mix( material.specularColor, diffuseColor.rgb, metalnessFactor );
	material.specularF90 = 1.0;
#endif
#ifdef USE_CLEARCOAT
	material.clearcoat = clearcoat;
	material.clearcoatRoughness = clearcoatRoughness;
	material.clearcoatF0 = vec3( 0.04 );
	material.clearcoatF90 = 1.0;
	#ifdef USE_CLEARCOATMAP
		material.clearcoat *= texture2D( clearcoatMap, vClearcoatMapUv ).x;
	#endif
	#ifdef USE_CLEARCOAT_ROUGHNESSMAP
		material.clearcoatRoughness *= texture2D( clearcoatRoughnessMap, vClearcoatRoughnessMapUv ).y;
	#endif
	material.clearcoat = saturate( material.clearcoat );	material.clearcoatRoughness = max( material.clearcoatRoughness, 0.045 );
	material.clearcoatRoughness += geometryRoughness;
	material.clearcoatRoughness = min( material.clearcoatRoughness, 1.0 );
#endif
#ifdef USE_DISPERSION
	material.dispersion = dispersion;
#endif
#ifdef USE_RETROREFLECTION
	material.retroreflectivity = retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	material.iridescence = iridescence;
	material.iridescenceIOR = iridescenceIOR;
	#ifdef USE_IRIDESCENCEMAP
		material.iridescence *= texture2D( iridescenceMap, vIridescenceMapUv ).r;
	#endif
	#ifdef USE_IRIDESCENCE_THICKNESSMAP
		material.iridescenceThickness = (iridescenceThicknessMaximum - iridescenceThicknessMinimum) * texture2D( iridescenceThicknessMap, vIridescenceThicknessMapUv ).g + iridescenceThicknessMinimum;
	#else
		material.iridescenceThickness = iridescenceThicknessMaximum;
	#endif
#endif
#ifdef USE_SHEEN
	material.sheenColor = sheenColor;
	#ifdef USE_SHEEN_COLORMAP
		material.sheenColor *= texture2D( sheenColorMap, vSheenColorMapUv ).rgb;
	#endif
	material.sheenRoughness = clamp( sheenRoughness, 0.0001, 1.0 );
	#ifdef USE_SHEEN_ROUGHNESSMAP
		material.sheenRoughness *= texture2D( sheenRoughnessMap, vSheenRoughnessMapUv ).a;
	#endif
#endif
#ifdef USE_ANISOTROPY
	#ifdef USE_ANISOTROPYMAP
		mat2 anisotropyMat = mat2( anisotropyVector.x, anisotropyVector.y, - anisotropyVector.y, anisotropyVector.x );
		vec3 anisotropyPolar = texture2D( anisotropyMap, vAnisotropyMapUv ).rgb;
		vec2 anisotropyV = anisotropyMat * normalize( 2.0 * anisotropyPolar.rg - vec2( 1.0 ) ) * anisotropyPolar.b;
	#else
		vec2 anisotropyV = anisotropyVector;
	#endif
	material.anisotropy = length( anisotropyV );
	if( material.anisotropy == 0.0 ) {
		anisotropyV = vec2( 1.0, 0.0 );
	} else {
		anisotropyV /= material.anisotropy;
		material.anisotropy = saturate( material.anisotropy );
	}
	material.alphaT = mix( pow2( material.roughness ), 1.0, pow2( material.anisotropy ) );
	material.anisotropyT = tbn[ 0 ] * anisotropyV.x + tbn[ 1 ] * anisotropyV.y;
	material.anisotropyB = tbn[ 1 ] * anisotropyV.x - tbn[ 0 ] * anisotropyV.y;
#endif`,jx=`uniform sampler2D dfgLUT;
struct PhysicalMaterial {
	vec3 diffuseColor;
	vec3 diffuseContribution;
	vec3 specularColor;
	vec3 specularColorBlended;
	float roughness;
	float metalness;
	float specularF90;
	float dispersion;
	vec2 dfg;
	vec3 multiScatteringCompensation;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float diffuseRoughness;
	#endif
	#ifdef USE_RETROREFLECTION
		float retroreflectivity;
	#endif
	#ifdef USE_CLEARCOAT
		float clearcoat;
		float clearcoatRoughness;
		vec3 clearcoatF0;
		float clearcoatF90;
	#endif
	#ifdef USE_IRIDESCENCE
		float iridescence;
		float iridescenceIOR;
		float iridescenceThickness;
		vec3 iridescenceFresnel;
		vec3 iridescenceF0Dielectric;
		vec3 iridescenceF0Metallic;
	#endif
	#ifdef USE_SHEEN
		vec3 sheenColor;
		float sheenRoughness;
	#endif
	#ifdef IOR
		float ior;
	#endif
	#ifdef USE_TRANSMISSION
		float transmission;
		float transmissionAlpha;
		float thickness;
		float attenuationDistance;
		vec3 attenuationColor;
	#endif
	#ifdef USE_ANISOTROPY
		float anisotropy;
		float alphaT;
		vec3 anisotropyT;
		vec3 anisotropyB;
	#endif
};
vec3 clearcoatSpecularDirect = vec3( 0.0 );
vec3 clearcoatSpecularIndirect = vec3( 0.0 );
vec3 sheenSpecularDirect = vec3( 0.0 );
vec3 sheenSpecularIndirect = vec3(0.0 );
vec3 Schlick_to_F0( const in vec3 f, const in float f90, const in float dotVH ) {
    float x = clamp( 1.0 - dotVH, 0.0, 1.0 );
    float x2 = x * x;
    float x5 = clamp( x * x2 * x2, 0.0, 0.9999 );
    return ( f - vec3( f90 ) * x5 ) / ( 1.0 - x5 );
}
#ifdef USE_DIFFUSE_ROUGHNESS
	const float EON_EPSILON = 1e-7;
	float FON_DirectionalAlbedo( const in float mu, const in float roughness, const in float A ) {
		float muComp = 1.0 - mu;
		float gOverPi = muComp * ( 0.0571085289 + muComp * ( 0.491881867 + muComp * ( - 0.332181442 + muComp * 0.0714429953 ) ) );
		return A * ( 1.0 + roughness * gOverPi );
	}
	vec3 BRDF_EON( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in vec3 diffuseColor, const in float roughness ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return BRDF_Lambert( rho );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float s = dot( lightDir, viewDir ) - dotNL * dotNV;
		float sOverT = ( s > 0.0 ) ? s / max( max( dotNL, dotNV ), EON_EPSILON ) : s;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		vec3 singleScatter = rho * RECIPROCAL_PI * A * ( 1.0 + roughness * sOverT );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		float albedoV = FON_DirectionalAlbedo( dotNV, roughness, A );
		float albedoL = FON_DirectionalAlbedo( dotNL, roughness, A );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		vec3 multiScatter = rhoMultiScatter * RECIPROCAL_PI
			* max( EON_EPSILON, 1.0 - albedoV )
			* max( EON_EPSILON, 1.0 - albedoL )
			/ max( EON_EPSILON, 1.0 - averageAlbedo );
		return singleScatter + multiScatter;
	}
	vec3 EON_DirectionalAlbedo( const in vec3 diffuseColor, const in float roughness, const in float dotNV ) {
		vec3 rho = saturate( diffuseColor );
		if ( roughness <= EON_EPSILON ) return rho;
		float A = 1.0 / ( 1.0 + ( 0.5 - 2.0 / ( 3.0 * PI ) ) * roughness );
		float directionalAlbedo = FON_DirectionalAlbedo( dotNV, roughness, A );
		float averageAlbedo = A * ( 1.0 + ( 2.0 / 3.0 - 28.0 / ( 15.0 * PI ) ) * roughness );
		vec3 rhoMultiScatter = rho * rho * averageAlbedo / max( vec3( EON_EPSILON ), vec3( 1.0 ) - rho * ( 1.0 - averageAlbedo ) );
		return rho * directionalAlbedo + rhoMultiScatter * ( 1.0 - directionalAlbedo );
	}
#endif
float V_GGX_SmithCorrelated( const in float alpha, const in float dotNL, const in float dotNV ) {
	float a2 = pow2( alpha );
	float gv = dotNL * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNV ) );
	float gl = dotNV * sqrt( a2 + ( 1.0 - a2 ) * pow2( dotNL ) );
	return 0.5 / max( gv + gl, EPSILON );
}
float D_GGX( const in float alpha, const in float dotNH ) {
	float a2 = pow2( alpha );
	float denom = pow2( dotNH ) * ( a2 - 1.0 ) + 1.0;
	return RECIPROCAL_PI * a2 / pow2( denom );
}
#ifdef USE_ANISOTROPY
	float V_GGX_SmithCorrelated_Anisotropic( const in float alphaT, const in float alphaB, const in float dotTV, const in float dotBV, const in float dotTL, const in float dotBL, const in float dotNV, const in float dotNL ) {
		float gv = dotNL * length( vec3( alphaT * dotTV, alphaB * dotBV, dotNV ) );
		float gl = dotNV * length( vec3( alphaT * dotTL, alphaB * dotBL, dotNL ) );
		return 0.5 / max( gv + gl, EPSILON );
	}
	float D_GGX_Anisotropic( const in float alphaT, const in float alphaB, const in float dotNH, const in float dotTH, const in float dotBH ) {
		float a2 = alphaT * alphaB;
		highp vec3 v = vec3( alphaB * dotTH, alphaT * dotBH, a2 * dotNH );
		highp float v2 = dot( v, v );
		float w2 = a2 / v2;
		return RECIPROCAL_PI * a2 * pow2 ( w2 );
	}
#endif
#ifdef USE_CLEARCOAT
	vec3 BRDF_GGX_Clearcoat( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material) {
		vec3 f0 = material.clearcoatF0;
		float f90 = material.clearcoatF90;
		float roughness = max( material.clearcoatRoughness, 0.045 );
		float alpha = pow2( roughness );
		vec3 halfDir = normalize( lightDir + viewDir );
		float dotNL = saturate( dot( normal, lightDir ) );
		float dotNV = saturate( dot( normal, viewDir ) );
		float dotNH = saturate( dot( normal, halfDir ) );
		float dotVH = saturate( dot( viewDir, halfDir ) );
		vec3 F = F_Schlick( f0, f90, dotVH );
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
		return F * ( V * D );
	}
#endif
vec3 BRDF_GGX( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, const in PhysicalMaterial material ) {
	vec3 f0 = material.specularColorBlended;
	float f90 = material.specularF90;
	float roughness = max( material.roughness, 0.045 );
	float alpha = pow2( roughness );
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float dotVH = saturate( dot( viewDir, halfDir ) );
	vec3 F = F_Schlick( f0, f90, dotVH );
	#ifdef USE_IRIDESCENCE
		F = mix( F, material.iridescenceFresnel, material.iridescence );
	#endif
	#ifdef USE_ANISOTROPY
		float dotTL = dot( material.anisotropyT, lightDir );
		float dotTV = dot( material.anisotropyT, viewDir );
		float dotTH = dot( material.anisotropyT, halfDir );
		float dotBL = dot( material.anisotropyB, lightDir );
		float dotBV = dot( material.anisotropyB, viewDir );
		float dotBH = dot( material.anisotropyB, halfDir );
		float alphaT = max( material.alphaT, alpha );
		float V = V_GGX_SmithCorrelated_Anisotropic( alphaT, alpha, dotTV, dotBV, dotTL, dotBL, dotNV, dotNL );
		float D = D_GGX_Anisotropic( alphaT, alpha, dotNH, dotTH, dotBH );
	#else
		float V = V_GGX_SmithCorrelated( alpha, dotNL, dotNV );
		float D = D_GGX( alpha, dotNH );
	#endif
	return F * ( V * D );
}
vec2 LTC_Uv( const in vec3 N, const in vec3 V, const in float roughness ) {
	const float LUT_SIZE = 64.0;
	const float LUT_SCALE = ( LUT_SIZE - 1.0 ) / LUT_SIZE;
	const float LUT_BIAS = 0.5 / LUT_SIZE;
	float dotNV = saturate( dot( N, V ) );
	vec2 uv = vec2( roughness, sqrt( 1.0 - dotNV ) );
	uv = uv * LUT_SCALE + LUT_BIAS;
	return uv;
}
float LTC_ClippedSphereFormFactor( const in vec3 f ) {
	float l = length( f );
	return max( ( l * l + f.z ) / ( l + 1.0 ), 0.0 );
}
vec3 LTC_EdgeVectorFormFactor( const in vec3 v1, const in vec3 v2 ) {
	float x = dot( v1, v2 );
	float y = abs( x );
	float a = 0.8543985 + ( 0.4965155 + 0.0145206 * y ) * y;
	float b = 3.4175940 + ( 4.1616724 + y ) * y;
	float v = a / b;
	float theta_sintheta = ( x > 0.0 ) ? v : 0.5 * inversesqrt( max( 1.0 - x * x, 1e-7 ) ) - v;
	return cross( v1, v2 ) * theta_sintheta;
}
vec3 LTC_Evaluate( const in vec3 N, const in vec3 V, const in vec3 P, const in mat3 mInv, const in vec3 rectCoords[ 4 ] ) {
	vec3 v1 = rectCoords[ 1 ] - rectCoords[ 0 ];
	vec3 v2 = rectCoords[ 3 ] - rectCoords[ 0 ];
	vec3 lightNormal = cross( v1, v2 );
	if( dot( lightNormal, P - rectCoords[ 0 ] ) < 0.0 ) return vec3( 0.0 );
	vec3 T1, T2;
	T1 = normalize( V - N * dot( V, N ) );
	T2 = - cross( N, T1 );
	mat3 mat = mInv * transpose( mat3( T1, T2, N ) );
	vec3 coords[ 4 ];
	coords[ 0 ] = mat * ( rectCoords[ 0 ] - P );
	coords[ 1 ] = mat * ( rectCoords[ 1 ] - P );
	coords[ 2 ] = mat * ( rectCoords[ 2 ] - P );
	coords[ 3 ] = mat * ( rectCoords[ 3 ] - P );
	coords[ 0 ] = normalize( coords[ 0 ] );
	coords[ 1 ] = normalize( coords[ 1 ] );
	coords[ 2 ] = normalize( coords[ 2 ] );
	coords[ 3 ] = normalize( coords[ 3 ] );
	vec3 vectorFormFactor = vec3( 0.0 );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 0 ], coords[ 1 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 1 ], coords[ 2 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 2 ], coords[ 3 ] );
	vectorFormFactor += LTC_EdgeVectorFormFactor( coords[ 3 ], coords[ 0 ] );
	float result = LTC_ClippedSphereFormFactor( vectorFormFactor );
	return vec3( result );
}
#if defined( USE_SHEEN )
float D_Charlie( float roughness, float dotNH ) {
	float alpha = pow2( roughness );
	float invAlpha = 1.0 / alpha;
	float cos2h = dotNH * dotNH;
	float sin2h = max( 1.0 - cos2h, 0.0078125 );
	return ( 2.0 + invAlpha ) * pow( sin2h, invAlpha * 0.5 ) / ( 2.0 * PI );
}
float V_Neubelt( float dotNV, float dotNL ) {
	return saturate( 1.0 / ( 4.0 * ( dotNL + dotNV - dotNL * dotNV ) ) );
}
vec3 BRDF_Sheen( const in vec3 lightDir, const in vec3 viewDir, const in vec3 normal, vec3 sheenColor, const in float sheenRoughness ) {
	vec3 halfDir = normalize( lightDir + viewDir );
	float dotNL = saturate( dot( normal, lightDir ) );
	float dotNV = saturate( dot( normal, viewDir ) );
	float dotNH = saturate( dot( normal, halfDir ) );
	float D = D_Charlie( sheenRoughness, dotNH );
	float V = V_Neubelt( dotNV, dotNL );
	return sheenColor * ( D * V );
}
#endif
float IBLSheenBRDF( const in vec3 normal, const in vec3 viewDir, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	float r2 = roughness * roughness;
	float rInv = 1.0 / ( roughness + 0.1 );
	float a = -1.9362 + 1.0678 * roughness + 0.4573 * r2 - 0.8469 * rInv;
	float b = -0.6014 + 0.5538 * roughness - 0.4670 * r2 - 0.1255 * rInv;
	float DG = exp( a * dotNV + b );
	return saturate( DG );
}
vec3 EnvironmentBRDF( const in vec3 normal, const in vec3 viewDir, const in vec3 specularColor, const in float specularF90, const in float roughness ) {
	float dotNV = saturate( dot( normal, viewDir ) );
	vec2 fab = texture2D( dfgLUT, vec2( roughness, dotNV ) ).rg;
	return specularColor * fab.x + specularF90 * fab.y;
}
#ifdef USE_IRIDESCENCE
void computeMultiscatteringIridescence( const in vec2 fab, const in vec3 specularColor, const in float specularF90, const in float iridescence, const in vec3 iridescenceF0, inout vec3 singleScatter, inout vec3 multiScatter ) {
#else
void computeMultiscattering( const in vec2 fab, const in vec3 specularColor, const in float specularF90, inout vec3 singleScatter, inout vec3 multiScatter ) {
#endif
	#ifdef USE_IRIDESCENCE
		vec3 Fr = mix( specularColor, iridescenceF0, iridescence );
	#else
		vec3 Fr = specularColor;
	#endif
	vec3 FssEss = Fr * fab.x + specularF90 * fab.y;
	float Ess = fab.x + fab.y;
	float Ems = 1.0 - Ess;
	vec3 Favg = Fr + ( 1.0 - Fr ) * 0.047619;	vec3 Fms = FssEss * Favg / ( 1.0 - Ems * Favg );
	singleScatter += FssEss;
	multiScatter += Fms * Ems;
}
#if NUM_RECT_AREA_LIGHTS > 0
	void RE_Direct_RectArea_Physical( const in RectAreaLight rectAreaLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
		vec3 normal = geometryNormal;
		vec3 viewDir = geometryViewDir;
		vec3 position = geometryPosition;
		vec3 lightPos = rectAreaLight.position;
		vec3 halfWidth = rectAreaLight.halfWidth;
		vec3 halfHeight = rectAreaLight.halfHeight;
		vec3 lightColor = rectAreaLight.color;
		float roughness = material.roughness;
		vec3 rectCoords[ 4 ];
		rectCoords[ 0 ] = lightPos + halfWidth - halfHeight;		rectCoords[ 1 ] = lightPos - halfWidth - halfHeight;
		rectCoords[ 2 ] = lightPos - halfWidth + halfHeight;
		rectCoords[ 3 ] = lightPos + halfWidth + halfHeight;
		vec2 uv = LTC_Uv( normal, viewDir, roughness );
		vec4 t1 = texture2D( ltc_1, uv );
		vec4 t2 = texture2D( ltc_2, uv );
		mat3 mInv = mat3(
			vec3( t1.x, 0, t1.y ),
			vec3(    0, 1,    0 ),
			vec3( t1.z, 0, t1.w )
		);
		vec3 fresnel = ( material.specularColorBlended * t2.x + ( material.specularF90 - material.specularColorBlended ) * t2.y );
		reflectedLight.directSpecular += lightColor * fresnel * LTC_Evaluate( normal, viewDir, position, mInv, rectCoords );
		reflectedLight.directDiffuse += lightColor * material.diffuseContribution * LTC_Evaluate( normal, viewDir, position, mat3( 1.0 ), rectCoords );
		#ifdef USE_CLEARCOAT
			vec3 Ncc = geometryClearcoatNormal;
			vec2 uvClearcoat = LTC_Uv( Ncc, viewDir, material.clearcoatRoughness );
			vec4 t1Clearcoat = texture2D( ltc_1, uvClearcoat );
			vec4 t2Clearcoat = texture2D( ltc_2, uvClearcoat );
			mat3 mInvClearcoat = mat3(
				vec3( t1Clearcoat.x, 0, t1Clearcoat.y ),
				vec3(             0, 1,             0 ),
				vec3( t1Clearcoat.z, 0, t1Clearcoat.w )
			);
			vec3 fresnelClearcoat = material.clearcoatF0 * t2Clearcoat.x + ( material.clearcoatF90 - material.clearcoatF0 ) * t2Clearcoat.y;
			clearcoatSpecularDirect += lightColor * fresnelClearcoat * LTC_Evaluate( Ncc, viewDir, position, mInvClearcoat, rectCoords );
		#endif
	}
#endif
void RE_Direct_Physical( const in IncidentLight directLight, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	float dotNL = saturate( dot( geometryNormal, directLight.direction ) );
	vec3 irradiance = dotNL * directLight.color;
	#ifdef USE_CLEARCOAT
		float dotNLcc = saturate( dot( geometryClearcoatNormal, directLight.direction ) );
		vec3 ccIrradiance = dotNLcc * directLight.color;
		clearcoatSpecularDirect += ccIrradiance * BRDF_GGX_Clearcoat( directLight.direction, geometryViewDir, geometryClearcoatNormal, material );
	#endif
	#ifdef USE_SHEEN
 
 		sheenSpecularDirect += irradiance * BRDF_Sheen( directLight.direction, geometryViewDir, geometryNormal, material.sheenColor, material.sheenRoughness );
 
 		float sheenAlbedoV = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
 		float sheenAlbedoL = IBLSheenBRDF( geometryNormal, directLight.direction, material.sheenRoughness );
 
 		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * max( sheenAlbedoV, sheenAlbedoL );
 
 		irradiance *= sheenEnergyComp;
 
 	#endif
	vec3 specularBRDF = BRDF_GGX( directLight.direction, geometryViewDir, geometryNormal, material );
	#ifdef USE_RETROREFLECTION
		vec3 retroViewDir = reflect( - geometryViewDir, geometryNormal );
		vec3 retroSpecularBRDF = BRDF_GGX( directLight.direction, retroViewDir, geometryNormal, material );
		specularBRDF = mix( specularBRDF, retroSpecularBRDF, saturate( material.retroreflectivity ) );
	#endif
	reflectedLight.directSpecular += irradiance * specularBRDF * material.multiScatteringCompensation;
	vec3 halfDir = normalize( directLight.direction + geometryViewDir );
	float dotVH = saturate( dot( geometryViewDir, halfDir ) );
	vec3 F = F_Schlick( material.specularColor, material.specularF90, dotVH );
	#ifdef USE_RETROREFLECTION
		vec3 retroHalfDir = normalize( directLight.direction + retroViewDir );
		float dotRetroVH = saturate( dot( retroViewDir, retroHalfDir ) );
		vec3 retroF = F_Schlick( material.specularColor, material.specularF90, dotRetroVH );
		F = mix( F, retroF, saturate( material.retroreflectivity ) );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		vec3 diffuseBRDF = BRDF_EON( directLight.direction, geometryViewDir, geometryNormal, material.diffuseColor, material.diffuseRoughness ) * ( 1.0 - material.metalness );
	#else
		vec3 diffuseBRDF = BRDF_Lambert( material.diffuseContribution );
	#endif
	reflectedLight.directDiffuse += irradiance * diffuseBRDF * ( 1.0 - F );
}
void RE_IndirectDiffuse_Physical( const in vec3 irradiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight ) {
	vec3 singleScattering = vec3( 0.0 );
	vec3 multiScattering = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScattering, multiScattering );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScattering, multiScattering );
	#endif
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuseAlbedo = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness );
		vec3 diffuse = irradiance * RECIPROCAL_PI * diffuseAlbedo * ( 1.0 - singleScattering - multiScattering );
	#else
		vec3 diffuse = irradiance * BRDF_Lambert( material.diffuseContribution ) * ( 1.0 - singleScattering - multiScattering );
	#endif
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		sheenSpecularIndirect += irradiance * material.sheenColor * sheenAlbedo * RECIPROCAL_PI;
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		diffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectDiffuse += diffuse;
}
void RE_IndirectSpecular_Physical( const in vec3 radiance, const in vec3 irradiance, const in vec3 clearcoatRadiance, const in vec3 geometryPosition, const in vec3 geometryNormal, const in vec3 geometryViewDir, const in vec3 geometryClearcoatNormal, const in PhysicalMaterial material, inout ReflectedLight reflectedLight) {
	#ifdef USE_CLEARCOAT
		clearcoatSpecularIndirect += clearcoatRadiance * EnvironmentBRDF( geometryClearcoatNormal, geometryViewDir, material.clearcoatF0, material.clearcoatF90, material.clearcoatRoughness );
	#endif
	#ifdef USE_SHEEN
		sheenSpecularIndirect += irradiance * material.sheenColor * IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness ) * RECIPROCAL_PI;
 	#endif
	vec3 singleScatteringDielectric = vec3( 0.0 );
	vec3 multiScatteringDielectric = vec3( 0.0 );
	vec3 singleScatteringMetallic = vec3( 0.0 );
	vec3 multiScatteringMetallic = vec3( 0.0 );
	#ifdef USE_IRIDESCENCE
		computeMultiscatteringIridescence( material.dfg, material.specularColor, material.specularF90, material.iridescence, material.iridescenceF0Dielectric, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscatteringIridescence( material.dfg, material.diffuseColor, material.specularF90, material.iridescence, material.iridescenceF0Metallic, singleScatteringMetallic, multiScatteringMetallic );
	#else
		computeMultiscattering( material.dfg, material.specularColor, material.specularF90, singleScatteringDielectric, multiScatteringDielectric );
		computeMultiscattering( material.dfg, material.diffuseColor, material.specularF90, singleScatteringMetallic, multiScatteringMetallic );
	#endif
	vec3 singleScattering = mix( singleScatteringDielectric, singleScatteringMetallic, material.metalness );
	vec3 multiScattering = mix( multiScatteringDielectric, multiScatteringMetallic, material.metalness );
	vec3 totalScatteringDielectric = singleScatteringDielectric + multiScatteringDielectric;
	#ifdef USE_DIFFUSE_ROUGHNESS
		float dotNV = saturate( dot( geometryNormal, geometryViewDir ) );
		vec3 diffuse = EON_DirectionalAlbedo( material.diffuseColor, material.diffuseRoughness, dotNV ) * ( 1.0 - material.metalness ) * ( 1.0 - totalScatteringDielectric );
	#else
		vec3 diffuse = material.diffuseContribution * ( 1.0 - totalScatteringDielectric );
	#endif
	vec3 cosineWeightedIrradiance = irradiance * RECIPROCAL_PI;
	vec3 indirectSpecular = radiance * singleScattering;
	indirectSpecular += multiScattering * cosineWeightedIrradiance;
	vec3 indirectDiffuse = diffuse * cosineWeightedIrradiance;
	#ifdef USE_SHEEN
		float sheenAlbedo = IBLSheenBRDF( geometryNormal, geometryViewDir, material.sheenRoughness );
		float sheenEnergyComp = 1.0 - max3( material.sheenColor ) * sheenAlbedo;
		indirectSpecular *= sheenEnergyComp;
		indirectDiffuse *= sheenEnergyComp;
	#endif
	reflectedLight.indirectSpecular += indirectSpecular;
	reflectedLight.indirectDiffuse += indirectDiffuse;
}
#define RE_Direct				RE_Direct_Physical
#define RE_Direct_RectArea		RE_Direct_RectArea_Physical
#define RE_IndirectDiffuse		RE_IndirectDiffuse_Physical
#define RE_IndirectSpecular		RE_IndirectSpecular_Physical
float computeSpecularOcclusion( const in float dotNV, const in float ambientOcclusion, const in float roughness ) {
	return saturate( pow( dotNV + ambientOcclusion, exp2( - 16.0 * roughness - 1.0 ) ) - 1.0 + ambientOcclusion );
}`,ey=`
vec3 geometryPosition = - vViewPosition;
vec3 geometryNormal = normal;
vec3 geometryViewDir = ( isOrthographic ) ? vec3( 0, 0, 1 ) : normalize( vViewPosition );
vec3 geometryClearcoatNormal = vec3( 0.0 );
#ifdef USE_CLEARCOAT
	geometryClearcoatNormal = clearcoatNormal;
#endif
#ifdef USE_IRIDESCENCE
	float dotNVi = saturate( dot( normal, geometryViewDir ) );
	if ( material.iridescenceThickness == 0.0 ) {
		material.iridescence = 0.0;
	} else {
		material.iridescence = saturate( material.iridescence );
	}
	if ( material.iridescence > 0.0 ) {
		vec3 iridescenceFresnelDielectric = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.specularColor );
		vec3 iridescenceFresnelMetallic = evalIridescence( 1.0, material.iridescenceIOR, dotNVi, material.iridescenceThickness, material.diffuseColor );
		material.iridescenceFresnel = mix( iridescenceFresnelDielectric, iridescenceFresnelMetallic, material.metalness );
		material.iridescenceF0Dielectric = Schlick_to_F0( iridescenceFresnelDielectric, 1.0, dotNVi );
		material.iridescenceF0Metallic = Schlick_to_F0( iridescenceFresnelMetallic, 1.0, dotNVi );
	}
#endif
#ifdef STANDARD
	float dotNVms = saturate( dot( geometryNormal, geometryViewDir ) );
	material.dfg = texture2D( dfgLUT, vec2( material.roughness, dotNVms ) ).rg;
	#if ( NUM_SUN_LIGHTS > 0 || NUM_DIR_LIGHTS > 0 || NUM_POINT_LIGHTS > 0 || NUM_SPOT_LIGHTS > 0 )
		float EssMs = material.dfg.x + material.dfg.y;
		material.multiScatteringCompensation = 1.0 + material.specularColorBlended * ( 1.0 / EssMs - 1.0 );
	#endif
#endif
IncidentLight directLight;
#if ( NUM_POINT_LIGHTS > 0 ) && defined( RE_Direct )
	PointLight pointLight;
	#if defined( USE_SHADOWMAP ) && NUM_POINT_LIGHT_SHADOWS > 0
	PointLightShadow pointLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHTS; i ++ ) {
		pointLight = pointLights[ i ];
		getPointLightInfo( pointLight, geometryPosition, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_POINT_LIGHT_SHADOWS ) && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
		pointLightShadow = pointLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getPointShadow( pointShadowMap[ i ], pointLightShadow.shadowMapSize, pointLightShadow.shadowIntensity, pointLightShadow.shadowBias, pointLightShadow.shadowRadius, vPointShadowCoord[ i ], pointLightShadow.shadowCameraNear, pointLightShadow.shadowCameraFar ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SPOT_LIGHTS > 0 ) && defined( RE_Direct )
	SpotLight spotLight;
	vec4 spotColor;
	vec3 spotLightCoord;
	bool inSpotLightMap;
	#if defined( USE_SHADOWMAP ) && NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHTS; i ++ ) {
		spotLight = spotLights[ i ];
		getSpotLightInfo( spotLight, geometryPosition, directLight );
		#if ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#define SPOT_LIGHT_MAP_INDEX UNROLLED_LOOP_INDEX
		#elif ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		#define SPOT_LIGHT_MAP_INDEX NUM_SPOT_LIGHT_MAPS
		#else
		#define SPOT_LIGHT_MAP_INDEX ( UNROLLED_LOOP_INDEX - NUM_SPOT_LIGHT_SHADOWS + NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS )
		#endif
		#if ( SPOT_LIGHT_MAP_INDEX < NUM_SPOT_LIGHT_MAPS )
			spotLightCoord = vSpotLightCoord[ i ].xyz / vSpotLightCoord[ i ].w;
			inSpotLightMap = all( lessThan( abs( spotLightCoord * 2. - 1. ), vec3( 1.0 ) ) );
			spotColor = texture2D( spotLightMap[ SPOT_LIGHT_MAP_INDEX ], spotLightCoord.xy );
			directLight.color = inSpotLightMap ? directLight.color * spotColor.rgb : directLight.color;
		#endif
		#undef SPOT_LIGHT_MAP_INDEX
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
		spotLightShadow = spotLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( spotShadowMap[ i ], spotLightShadow.shadowMapSize, spotLightShadow.shadowIntensity, spotLightShadow.shadowBias, spotLightShadow.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_SUN_LIGHTS > 0 ) && defined( RE_Direct )
	SunLight sunLight;
	#if defined( USE_SHADOWMAP ) && NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHTS; i ++ ) {
		sunLight = sunLights[ i ];
		getSunLightInfo( sunLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_SUN_LIGHT_SHADOWS )
		sunLightShadow = sunLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getSunShadow( sunShadowMap[ i ], sunLightShadow, UNROLLED_LOOP_INDEX ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_DIR_LIGHTS > 0 ) && defined( RE_Direct )
	DirectionalLight directionalLight;
	#if defined( USE_SHADOWMAP ) && NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLightShadow;
	#endif
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHTS; i ++ ) {
		directionalLight = directionalLights[ i ];
		getDirectionalLightInfo( directionalLight, directLight );
		#if defined( USE_SHADOWMAP ) && ( UNROLLED_LOOP_INDEX < NUM_DIR_LIGHT_SHADOWS )
		directionalLightShadow = directionalLightShadows[ i ];
		directLight.color *= ( directLight.visible && receiveShadow ) ? getShadow( directionalShadowMap[ i ], directionalLightShadow.shadowMapSize, directionalLightShadow.shadowIntensity, directionalLightShadow.shadowBias, directionalLightShadow.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
		#endif
		RE_Direct( directLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if ( NUM_RECT_AREA_LIGHTS > 0 ) && defined( RE_Direct_RectArea )
	RectAreaLight rectAreaLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_RECT_AREA_LIGHTS; i ++ ) {
		rectAreaLight = rectAreaLights[ i ];
		RE_Direct_RectArea( rectAreaLight, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
	}
	#pragma unroll_loop_end
#endif
#if defined( RE_IndirectDiffuse )
	vec3 iblIrradiance = vec3( 0.0 );
	vec3 irradiance = getAmbientLightIrradiance( ambientLightColor );
	#if defined( USE_LIGHT_PROBES )
		irradiance += getLightProbeIrradiance( lightProbe, geometryNormal );
	#endif
	#if ( NUM_HEMI_LIGHTS > 0 )
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_HEMI_LIGHTS; i ++ ) {
			irradiance += getHemisphereLightIrradiance( hemisphereLights[ i ], geometryNormal );
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_LIGHT_PROBE_GRIDS > 0
		vec3 probeWorldPos = ( ( vec4( geometryPosition, 1.0 ) - viewMatrix[ 3 ] ) * viewMatrix ).xyz;
		vec3 probeWorldNormal = transformNormalByInverseViewMatrix( geometryNormal, viewMatrix );
		int probeGrid = - 1;
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( isInsideLightProbeGrid( probeWorldPos, probeWorldNormal, probesMin[ i ], probesMax[ i ], probesResolution[ i ] ) ) probeGrid = UNROLLED_LOOP_INDEX;
		}
		#pragma unroll_loop_end
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_LIGHT_PROBE_GRIDS; i ++ ) {
			if ( probeGrid == UNROLLED_LOOP_INDEX ) irradiance += getLightProbeGridIrradiance( probesSH[ i ], probesMin[ i ], probesMax[ i ], probesResolution[ i ], probeWorldPos, probeWorldNormal );
		}
		#pragma unroll_loop_end
	#endif
#endif
#if defined( RE_IndirectSpecular )
	vec3 radiance = vec3( 0.0 );
	vec3 clearcoatRadiance = vec3( 0.0 );
#endif`,ty=`#if defined( RE_IndirectDiffuse )
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		vec3 lightMapIrradiance = lightMapTexel.rgb * lightMapIntensity;
		irradiance += lightMapIrradiance;
	#endif
	#if defined( USE_ENVMAP ) && defined( ENVMAP_TYPE_PMREM )
		#if defined( STANDARD ) || defined( LAMBERT ) || defined( PHONG )
			iblIrradiance += getIBLIrradiance( geometryNormal );
		#endif
	#endif
#endif
#if defined( USE_ENVMAP ) && defined( RE_IndirectSpecular )
	#ifdef USE_ANISOTROPY
		vec3 iblRadiance = getIBLAnisotropyRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
	#else
		vec3 iblRadiance = getIBLRadiance( geometryViewDir, geometryNormal, material.roughness );
	#endif
	#ifdef USE_RETROREFLECTION
		#ifdef USE_ANISOTROPY
			vec3 retroIBLRadiance = getIBLAnisotropyRetroRadiance( geometryViewDir, geometryNormal, material.roughness, material.anisotropyB, material.anisotropy );
		#else
			vec3 retroIBLRadiance = getIBLRetroRadiance( geometryViewDir, geometryNormal, material.roughness );
		#endif
		iblRadiance = mix( iblRadiance, retroIBLRadiance, saturate( material.retroreflectivity ) );
	#endif
	radiance += iblRadiance;
	#ifdef USE_CLEARCOAT
		clearcoatRadiance += getIBLRadiance( geometryViewDir, geometryClearcoatNormal, material.clearcoatRoughness );
	#endif
#endif`,ny=`#if defined( RE_IndirectDiffuse )
	#if defined( LAMBERT ) || defined( PHONG )
		irradiance += iblIrradiance;
	#endif
	RE_IndirectDiffuse( irradiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif
#if defined( RE_IndirectSpecular )
	RE_IndirectSpecular( radiance, iblIrradiance, clearcoatRadiance, geometryPosition, geometryNormal, geometryViewDir, geometryClearcoatNormal, material, reflectedLight );
#endif`,iy=`#if NUM_LIGHT_PROBE_GRIDS > 0
uniform highp sampler3D probesSH[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMin[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesMax[ NUM_LIGHT_PROBE_GRIDS ];
uniform vec3 probesResolution[ NUM_LIGHT_PROBE_GRIDS ];
bool isInsideLightProbeGrid( vec3 worldPos, vec3 worldNormal, vec3 probesMin, vec3 probesMax, vec3 probesResolution ) {
	vec3 spacing = ( probesMax - probesMin ) / probesResolution;
	vec3 samplePos = worldPos + worldNormal * spacing * 0.5;
	vec3 margin = spacing * 0.01;
	return all( greaterThanEqual( samplePos, probesMin - margin ) ) && all( lessThanEqual( samplePos, probesMax + margin ) );
}
vec3 getLightProbeGridIrradiance( highp sampler3D probesSH, vec3 probesMin, vec3 probesMax, vec3 probesResolution, vec3 worldPos, vec3 worldNormal ) {
	vec3 res = probesResolution;
	vec3 gridRange = probesMax - probesMin;
	vec3 probeSpacing = gridRange / res;
	vec3 samplePos = worldPos + worldNormal * probeSpacing * 0.5;
	vec3 uvw = clamp( ( samplePos - probesMin ) / gridRange, 0.5 / res, 1.0 - 0.5 / res );
	float nz          = res.z;
	float paddedSlices = nz + 2.0;
	float atlasDepth  = 7.0 * paddedSlices;
	float uvZBase     = uvw.z * nz + 1.0;
	vec4 s0 = texture( probesSH, vec3( uvw.xy, ( uvZBase                       ) / atlasDepth ) );
	vec4 s1 = texture( probesSH, vec3( uvw.xy, ( uvZBase +       paddedSlices   ) / atlasDepth ) );
	vec4 s2 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 2.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s3 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 3.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s4 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 4.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s5 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 5.0 * paddedSlices   ) / atlasDepth ) );
	vec4 s6 = texture( probesSH, vec3( uvw.xy, ( uvZBase + 6.0 * paddedSlices   ) / atlasDepth ) );
	vec3 c0 = s0.xyz;
	vec3 c1 = vec3( s0.w, s1.xy );
	vec3 c2 = vec3( s1.zw, s2.x );
	vec3 c3 = s2.yzw;
	vec3 c4 = s3.xyz;
	vec3 c5 = vec3( s3.w, s4.xy );
	vec3 c6 = vec3( s4.zw, s5.x );
	vec3 c7 = s5.yzw;
	vec3 c8 = s6.xyz;
	float x = worldNormal.x, y = worldNormal.y, z = worldNormal.z;
	vec3 result = c0 * 0.886227;
	result += c1 * 2.0 * 0.511664 * y;
	result += c2 * 2.0 * 0.511664 * z;
	result += c3 * 2.0 * 0.511664 * x;
	result += c4 * 2.0 * 0.429043 * x * y;
	result += c5 * 2.0 * 0.429043 * y * z;
	result += c6 * ( 0.743125 * z * z - 0.247708 );
	result += c7 * 2.0 * 0.429043 * x * z;
	result += c8 * 0.429043 * ( x * x - y * y );
	return max( result, vec3( 0.0 ) );
}
#endif`,sy=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	gl_FragDepth = vIsPerspective == 0.0 ? gl_FragCoord.z : log2( vFragDepth ) * logDepthBufFC * 0.5;
#endif`,ry=`#if defined( USE_LOGARITHMIC_DEPTH_BUFFER )
	uniform float logDepthBufFC;
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,oy=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	varying float vFragDepth;
	varying float vIsPerspective;
#endif`,ay=`#ifdef USE_LOGARITHMIC_DEPTH_BUFFER
	vFragDepth = 1.0 + gl_Position.w;
	vIsPerspective = float( isPerspectiveMatrix( projectionMatrix ) );
#endif`,ly=`#ifdef USE_MAP
	vec4 sampledDiffuseColor = texture2D( map, vMapUv );
	#ifdef DECODE_VIDEO_TEXTURE
		sampledDiffuseColor = sRGBTransferEOTF( sampledDiffuseColor );
	#endif
	diffuseColor *= sampledDiffuseColor;
#endif`,cy=`#ifdef USE_MAP
	uniform sampler2D map;
#endif`,hy=`#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
	#if defined( USE_POINTS_UV )
		vec2 uv = vUv;
	#else
		vec2 uv = ( uvTransform * vec3( gl_PointCoord.x, 1.0 - gl_PointCoord.y, 1 ) ).xy;
	#endif
#endif
#ifdef USE_MAP
	diffuseColor *= texture2D( map, uv );
#endif
#ifdef USE_ALPHAMAP
	diffuseColor.a *= texture2D( alphaMap, uv ).g;
#endif`,uy=`#if defined( USE_POINTS_UV )
	varying vec2 vUv;
#else
	#if defined( USE_MAP ) || defined( USE_ALPHAMAP )
		uniform mat3 uvTransform;
	#endif
#endif
#ifdef USE_MAP
	uniform sampler2D map;
#endif
#ifdef USE_ALPHAMAP
	uniform sampler2D alphaMap;
#endif`,dy=`float metalnessFactor = metalness;
#ifdef USE_METALNESSMAP
	vec4 texelMetalness = texture2D( metalnessMap, vMetalnessMapUv );
	metalnessFactor *= texelMetalness.b;
#endif`,fy=`#ifdef USE_METALNESSMAP
	uniform sampler2D metalnessMap;
#endif`,py=`#ifdef USE_INSTANCING_MORPH
	float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	float morphTargetBaseInfluence = texelFetch( morphTexture, ivec2( 0, gl_InstanceID ), 0 ).r;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		morphTargetInfluences[i] =  texelFetch( morphTexture, ivec2( i + 1, gl_InstanceID ), 0 ).r;
	}
#endif`,my=`#if defined( USE_MORPHCOLORS )
	#if defined( USE_COLOR_ALPHA )
		vColor *= morphTargetBaseInfluence;
	#elif defined( USE_COLOR )
		vColor.rgb *= morphTargetBaseInfluence;
	#endif
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		#if defined( USE_COLOR_ALPHA )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor += getMorph( gl_VertexID, i, 2 ) * morphTargetInfluences[ i ];
		#elif defined( USE_COLOR )
			if ( morphTargetInfluences[ i ] != 0.0 ) vColor.rgb += getMorph( gl_VertexID, i, 2 ).rgb * morphTargetInfluences[ i ];
		#endif
	}
#endif`,gy=`#ifdef USE_MORPHNORMALS
	objectNormal *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) objectNormal += getMorph( gl_VertexID, i, 1 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,_y=`#ifdef USE_MORPHTARGETS
	#ifndef USE_INSTANCING_MORPH
		uniform float morphTargetBaseInfluence;
		uniform float morphTargetInfluences[ MORPHTARGETS_COUNT ];
	#endif
	uniform sampler2DArray morphTargetsTexture;
	uniform ivec2 morphTargetsTextureSize;
	vec4 getMorph( const in int vertexIndex, const in int morphTargetIndex, const in int offset ) {
		int texelIndex = vertexIndex * MORPHTARGETS_TEXTURE_STRIDE + offset;
		int y = texelIndex / morphTargetsTextureSize.x;
		int x = texelIndex - y * morphTargetsTextureSize.x;
		ivec3 morphUV = ivec3( x, y, morphTargetIndex );
		return texelFetch( morphTargetsTexture, morphUV, 0 );
	}
#endif`,vy=`#ifdef USE_MORPHTARGETS
	transformed *= morphTargetBaseInfluence;
	for ( int i = 0; i < MORPHTARGETS_COUNT; i ++ ) {
		if ( morphTargetInfluences[ i ] != 0.0 ) transformed += getMorph( gl_VertexID, i, 0 ).xyz * morphTargetInfluences[ i ];
	}
#endif`,xy=`float faceDirection = gl_FrontFacing ? 1.0 : - 1.0;
#ifdef FLAT_SHADED
	vec3 fdx = dFdx( vViewPosition );
	vec3 fdy = dFdy( vViewPosition );
	vec3 normal = normalize( cross( fdx, fdy ) );
#else
	vec3 normal = normalize( vNormal );
	#ifdef DOUBLE_SIDED
		normal *= faceDirection;
	#endif
#endif
#if defined( USE_NORMALMAP_TANGENTSPACE ) || defined( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY )
	#ifdef USE_TANGENT
		mat3 tbn = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn = getTangentFrame( - vViewPosition, normal,
		#if defined( USE_NORMALMAP )
			vNormalMapUv
		#elif defined( USE_CLEARCOAT_NORMALMAP )
			vClearcoatNormalMapUv
		#else
			vUv
		#endif
		);
	#endif
	#ifdef DOUBLE_SIDED
		tbn[0] *= faceDirection;
		tbn[1] *= faceDirection;
	#endif
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	#ifdef USE_TANGENT
		mat3 tbn2 = mat3( normalize( vTangent ), normalize( vBitangent ), normal );
	#else
		mat3 tbn2 = getTangentFrame( - vViewPosition, normal, vClearcoatNormalMapUv );
	#endif
	#ifdef DOUBLE_SIDED
		tbn2[0] *= faceDirection;
		tbn2[1] *= faceDirection;
	#endif
#endif
vec3 nonPerturbedNormal = normal;`,yy=`#ifdef USE_NORMALMAP_OBJECTSPACE
	normal = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#ifdef FLIP_SIDED
		normal = - normal;
	#endif
	#ifdef DOUBLE_SIDED
		normal = normal * faceDirection;
	#endif
	normal = normalize( normalMatrix * normal );
#elif defined( USE_NORMALMAP_TANGENTSPACE )
	vec3 mapN = texture2D( normalMap, vNormalMapUv ).xyz * 2.0 - 1.0;
	#if defined( USE_PACKED_NORMALMAP )
		mapN = vec3( mapN.xy, sqrt( saturate( 1.0 - dot( mapN.xy, mapN.xy ) ) ) );
	#endif
	mapN.xy *= normalScale;
	normal = normalize( tbn * mapN );
#elif defined( USE_BUMPMAP )
	normal = perturbNormalArb( - vViewPosition, normal, dHdxy_fwd(), faceDirection );
#endif`,Sy=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,My=`#ifndef FLAT_SHADED
	varying vec3 vNormal;
	#ifdef USE_TANGENT
		varying vec3 vTangent;
		varying vec3 vBitangent;
	#endif
#endif`,by=`#ifndef FLAT_SHADED
	vNormal = normalize( transformedNormal );
	#ifdef USE_TANGENT
		vTangent = normalize( transformedTangent );
		vBitangent = normalize( cross( vNormal, vTangent ) * tangent.w );
		#ifdef FLIP_SIDED
			vBitangent = - vBitangent;
		#endif
	#endif
#endif`,wy=`#ifdef USE_NORMALMAP
	uniform sampler2D normalMap;
	uniform vec2 normalScale;
#endif
#ifdef USE_NORMALMAP_OBJECTSPACE
	uniform mat3 normalMatrix;
#endif
#if ! defined ( USE_TANGENT ) && ( defined ( USE_NORMALMAP_TANGENTSPACE ) || defined ( USE_CLEARCOAT_NORMALMAP ) || defined( USE_ANISOTROPY ) )
	mat3 getTangentFrame( vec3 eye_pos, vec3 surf_norm, vec2 uv ) {
		vec3 q0 = dFdx( eye_pos.xyz );
		vec3 q1 = dFdy( eye_pos.xyz );
		vec2 st0 = dFdx( uv.st );
		vec2 st1 = dFdy( uv.st );
		vec3 N = surf_norm;
		vec3 q1perp = cross( q1, N );
		vec3 q0perp = cross( N, q0 );
		vec3 T = q1perp * st0.x + q0perp * st1.x;
		vec3 B = q1perp * st0.y + q0perp * st1.y;
		float det = max( dot( T, T ), dot( B, B ) );
		float scale = ( det == 0.0 ) ? 0.0 : inversesqrt( det );
		return mat3( T * scale, B * scale, N );
	}
#endif`,Ey=`#ifdef USE_CLEARCOAT
	vec3 clearcoatNormal = nonPerturbedNormal;
#endif`,Ty=`#ifdef USE_CLEARCOAT_NORMALMAP
	vec3 clearcoatMapN = texture2D( clearcoatNormalMap, vClearcoatNormalMapUv ).xyz * 2.0 - 1.0;
	clearcoatMapN.xy *= clearcoatNormalScale;
	clearcoatNormal = normalize( tbn2 * clearcoatMapN );
#endif`,Ay=`#ifdef USE_CLEARCOATMAP
	uniform sampler2D clearcoatMap;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform sampler2D clearcoatNormalMap;
	uniform vec2 clearcoatNormalScale;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform sampler2D clearcoatRoughnessMap;
#endif`,Ry=`#ifdef USE_IRIDESCENCEMAP
	uniform sampler2D iridescenceMap;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform sampler2D iridescenceThicknessMap;
#endif`,Cy=`#ifdef OPAQUE
diffuseColor.a = 1.0;
#endif
#ifdef USE_TRANSMISSION
diffuseColor.a *= material.transmissionAlpha;
#endif
gl_FragColor = vec4( outgoingLight, diffuseColor.a );`,Py=`vec3 packNormalToRGB( const in vec3 normal ) {
	return normalize( normal ) * 0.5 + 0.5;
}
vec3 unpackRGBToNormal( const in vec3 rgb ) {
	return 2.0 * rgb.xyz - 1.0;
}
const float PackUpscale = 256. / 255.;const float UnpackDownscale = 255. / 256.;const float ShiftRight8 = 1. / 256.;
const float Inv255 = 1. / 255.;
const vec4 PackFactors = vec4( 1.0, 256.0, 256.0 * 256.0, 256.0 * 256.0 * 256.0 );
const vec2 UnpackFactors2 = vec2( UnpackDownscale, 1.0 / PackFactors.g );
const vec3 UnpackFactors3 = vec3( UnpackDownscale / PackFactors.rg, 1.0 / PackFactors.b );
const vec4 UnpackFactors4 = vec4( UnpackDownscale / PackFactors.rgb, 1.0 / PackFactors.a );
vec4 packDepthToRGBA( const in float v ) {
	if( v <= 0.0 )
		return vec4( 0., 0., 0., 0. );
	if( v >= 1.0 )
		return vec4( 1., 1., 1., 1. );
	float vuf;
	float af = modf( v * PackFactors.a, vuf );
	float bf = modf( vuf * ShiftRight8, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec4( vuf * Inv255, gf * PackUpscale, bf * PackUpscale, af );
}
vec3 packDepthToRGB( const in float v ) {
	if( v <= 0.0 )
		return vec3( 0., 0., 0. );
	if( v >= 1.0 )
		return vec3( 1., 1., 1. );
	float vuf;
	float bf = modf( v * PackFactors.b, vuf );
	float gf = modf( vuf * ShiftRight8, vuf );
	return vec3( vuf * Inv255, gf * PackUpscale, bf );
}
vec2 packDepthToRG( const in float v ) {
	if( v <= 0.0 )
		return vec2( 0., 0. );
	if( v >= 1.0 )
		return vec2( 1., 1. );
	float vuf;
	float gf = modf( v * 256., vuf );
	return vec2( vuf * Inv255, gf );
}
float unpackRGBAToDepth( const in vec4 v ) {
	return dot( v, UnpackFactors4 );
}
float unpackRGBToDepth( const in vec3 v ) {
	return dot( v, UnpackFactors3 );
}
float unpackRGToDepth( const in vec2 v ) {
	return v.r * UnpackFactors2.r + v.g * UnpackFactors2.g;
}
vec4 pack2HalfToRGBA( const in vec2 v ) {
	vec4 r = vec4( v.x, fract( v.x * 255.0 ), v.y, fract( v.y * 255.0 ) );
	return vec4( r.x - r.y / 255.0, r.y, r.z - r.w / 255.0, r.w );
}
vec2 unpackRGBATo2Half( const in vec4 v ) {
	return vec2( v.x + ( v.y / 255.0 ), v.z + ( v.w / 255.0 ) );
}
float viewZToOrthographicDepth( const in float viewZ, const in float near, const in float far ) {
	return ( viewZ + near ) / ( near - far );
}
float orthographicDepthToViewZ( const in float depth, const in float near, const in float far ) {
	#ifdef USE_REVERSED_DEPTH_BUFFER
	
		return depth * ( far - near ) - far;
	#else
		return depth * ( near - far ) - near;
	#endif
}
float viewZToPerspectiveDepth( const in float viewZ, const in float near, const in float far ) {
	return ( ( near + viewZ ) * far ) / ( ( far - near ) * viewZ );
}
float perspectiveDepthToViewZ( const in float depth, const in float near, const in float far ) {
	
	#ifdef USE_REVERSED_DEPTH_BUFFER
		return ( near * far ) / ( ( near - far ) * depth - near );
	#else
		return ( near * far ) / ( ( far - near ) * depth - far );
	#endif
}`,Iy=`#ifdef PREMULTIPLIED_ALPHA
	gl_FragColor.rgb *= gl_FragColor.a;
#endif`,Ly=`vec4 mvPosition = vec4( transformed, 1.0 );
#ifdef USE_BATCHING
	mvPosition = batchingMatrix * mvPosition;
#endif
#ifdef USE_INSTANCING
	mvPosition = instanceMatrix * mvPosition;
#endif
mvPosition = modelViewMatrix * mvPosition;
gl_Position = projectionMatrix * mvPosition;`,Dy=`#ifdef DITHERING
	gl_FragColor.rgb = dithering( gl_FragColor.rgb );
#endif`,Ny=`#ifdef DITHERING
	vec3 dithering( vec3 color ) {
		float grid_position = rand( gl_FragCoord.xy );
		vec3 dither_shift_RGB = vec3( 0.25 / 255.0, -0.25 / 255.0, 0.25 / 255.0 );
		dither_shift_RGB = mix( 2.0 * dither_shift_RGB, -2.0 * dither_shift_RGB, grid_position );
		return color + dither_shift_RGB;
	}
#endif`,Uy=`float roughnessFactor = roughness;
#ifdef USE_ROUGHNESSMAP
	vec4 texelRoughness = texture2D( roughnessMap, vRoughnessMapUv );
	roughnessFactor *= texelRoughness.g;
#endif`,Fy=`#ifdef USE_ROUGHNESSMAP
	uniform sampler2D roughnessMap;
#endif`,Oy=`#if NUM_SPOT_LIGHT_COORDS > 0
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#if NUM_SPOT_LIGHT_MAPS > 0
	uniform sampler2D spotLightMap[ NUM_SPOT_LIGHT_MAPS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		#define SUN_LIGHT_CASCADES 2
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#else
			uniform sampler2D sunShadowMap[ NUM_SUN_LIGHT_SHADOWS ];
		#endif
		uniform mat4 sunShadowMatrix[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		uniform vec4 sunShadowCascade[ NUM_SUN_LIGHT_SHADOWS * SUN_LIGHT_CASCADES ];
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
		struct SunLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SunLightShadow sunLightShadows[ NUM_SUN_LIGHT_SHADOWS ];
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#else
			uniform sampler2D directionalShadowMap[ NUM_DIR_LIGHT_SHADOWS ];
		#endif
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform sampler2DShadow spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#else
			uniform sampler2D spotShadowMap[ NUM_SPOT_LIGHT_SHADOWS ];
		#endif
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#if defined( SHADOWMAP_TYPE_PCF )
			uniform samplerCubeShadow pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#elif defined( SHADOWMAP_TYPE_BASIC )
			uniform samplerCube pointShadowMap[ NUM_POINT_LIGHT_SHADOWS ];
		#endif
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float interleavedGradientNoise( vec2 position ) {
			return fract( 52.9829189 * fract( dot( position, vec2( 0.06711056, 0.00583715 ) ) ) );
		}
		vec2 vogelDiskSample( int sampleIndex, int samplesCount, float phi ) {
			const float goldenAngle = 2.399963229728653;
			float r = sqrt( ( float( sampleIndex ) + 0.5 ) / float( samplesCount ) );
			float theta = float( sampleIndex ) * goldenAngle + phi;
			return vec2( cos( theta ), sin( theta ) ) * r;
		}
	#endif
	#if defined( SHADOWMAP_TYPE_PCF )
		float getShadow( sampler2DShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 texelSize = vec2( 1.0 ) / shadowMapSize;
				vec2 radius = shadowRadius * texelSize;
				float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
				shadow = (
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 0, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 1, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 2, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 3, 5, phi ) * radius, shadowCoord.z ) ) +
					texture( shadowMap, vec3( shadowCoord.xy + vogelDiskSample( 4, 5, phi ) * radius, shadowCoord.z ) )
				) * 0.2;
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#elif defined( SHADOWMAP_TYPE_VSM )
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				vec2 distribution = texture2D( shadowMap, shadowCoord.xy ).rg;
				float mean = distribution.x;
				float variance = distribution.y * distribution.y;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					float hard_shadow = step( mean, shadowCoord.z );
				#else
					float hard_shadow = step( shadowCoord.z, mean );
				#endif
				
				if ( hard_shadow == 1.0 ) {
					shadow = 1.0;
				} else {
					variance = max( variance, 0.0000001 );
					float d = shadowCoord.z - mean;
					float p_max = variance / ( variance + d * d );
					p_max = clamp( ( p_max - 0.3 ) / 0.65, 0.0, 1.0 );
					shadow = max( hard_shadow, p_max );
				}
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#else
		float getShadow( sampler2D shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord ) {
			float shadow = 1.0;
			shadowCoord.xyz /= shadowCoord.w;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				shadowCoord.z -= shadowBias;
			#else
				shadowCoord.z += shadowBias;
			#endif
			bool inFrustum = shadowCoord.x >= 0.0 && shadowCoord.x <= 1.0 && shadowCoord.y >= 0.0 && shadowCoord.y <= 1.0;
			bool frustumTest = inFrustum && shadowCoord.z <= 1.0;
			if ( frustumTest ) {
				float depth = texture2D( shadowMap, shadowCoord.xy ).r;
				#ifdef USE_REVERSED_DEPTH_BUFFER
					shadow = step( depth, shadowCoord.z );
				#else
					shadow = step( shadowCoord.z, depth );
				#endif
			}
			return mix( 1.0, shadow, shadowIntensity );
		}
	#endif
	#if NUM_SUN_LIGHT_SHADOWS > 0
		float getSunShadow(
			#if defined( SHADOWMAP_TYPE_PCF )
				sampler2DShadow shadowMap,
			#else
				sampler2D shadowMap,
			#endif
			SunLightShadow sunLightShadow,
			int shadowIndex
		) {
			vec4 shadowWorldPosition = vec4( vSunShadowWorldPosition.xyz + vSunShadowWorldNormal * sunLightShadow.shadowNormalBias, 1.0 );
			float viewDepth = vSunShadowWorldPosition.w;
			int cascadeOffset = shadowIndex * SUN_LIGHT_CASCADES;
			float shadow = 1.0;
			for ( int i = SUN_LIGHT_CASCADES - 1; i >= 0; i -- ) {
				vec4 cascade = sunShadowCascade[ cascadeOffset + i ];
				if ( viewDepth >= cascade.x && viewDepth < cascade.y ) {
					float cascadeShadow = getShadow(
						shadowMap,
						sunLightShadow.shadowMapSize,
						sunLightShadow.shadowIntensity,
						sunLightShadow.shadowBias,
						sunLightShadow.shadowRadius,
						sunShadowMatrix[ cascadeOffset + i ] * shadowWorldPosition
					);
					shadow = mix( cascadeShadow, shadow, smoothstep( cascade.z, cascade.y, viewDepth ) );
				}
			}
			return shadow;
		}
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
	#if defined( SHADOWMAP_TYPE_PCF )
	float getPointShadow( samplerCubeShadow shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 bd3D = normalize( lightToPosition );
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float lightDistance = length( lightToPosition );
			float depthRange = shadowCameraFar - shadowCameraNear;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				float depthA = - shadowCameraNear / depthRange - shadowBias;
				float depthB = shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#else
				float depthA = shadowCameraFar / depthRange + shadowBias;
				float depthB = - shadowCameraNear * shadowCameraFar / ( depthRange * lightDistance );
			#endif
			float texelSize = shadowRadius / shadowMapSize.x;
			vec3 absDir = abs( bd3D );
			vec3 tangent = absDir.x > absDir.z ? vec3( 0.0, 1.0, 0.0 ) : vec3( 1.0, 0.0, 0.0 );
			tangent = normalize( cross( bd3D, tangent ) );
			vec3 bitangent = cross( bd3D, tangent );
			float phi = interleavedGradientNoise( gl_FragCoord.xy ) * PI2;
			shadow = 0.0;
			for ( int i = 0; i < 5; i ++ ) {
				vec2 offset = vogelDiskSample( i, 5, phi );
				vec3 direction = bd3D + ( tangent * offset.x + bitangent * offset.y ) * texelSize;
				vec3 absDirection = abs( direction );
				float dp = depthA + depthB / max( max( absDirection.x, absDirection.y ), absDirection.z );
				shadow += texture( shadowMap, vec4( direction, dp ) );
			}
			shadow *= 0.2;
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#elif defined( SHADOWMAP_TYPE_BASIC )
	float getPointShadow( samplerCube shadowMap, vec2 shadowMapSize, float shadowIntensity, float shadowBias, float shadowRadius, vec4 shadowCoord, float shadowCameraNear, float shadowCameraFar ) {
		float shadow = 1.0;
		vec3 lightToPosition = shadowCoord.xyz;
		vec3 absVec = abs( lightToPosition );
		float viewSpaceZ = max( max( absVec.x, absVec.y ), absVec.z );
		if ( viewSpaceZ - shadowCameraFar <= 0.0 && viewSpaceZ - shadowCameraNear >= 0.0 ) {
			float dp = ( shadowCameraFar * ( viewSpaceZ - shadowCameraNear ) ) / ( viewSpaceZ * ( shadowCameraFar - shadowCameraNear ) );
			dp += shadowBias;
			vec3 bd3D = normalize( lightToPosition );
			float depth = textureCube( shadowMap, bd3D ).r;
			#ifdef USE_REVERSED_DEPTH_BUFFER
				depth = 1.0 - depth;
			#endif
			shadow = step( dp, depth );
		}
		return mix( 1.0, shadow, shadowIntensity );
	}
	#endif
	#endif
#endif`,By=`#if NUM_SPOT_LIGHT_COORDS > 0
	uniform mat4 spotLightMatrix[ NUM_SPOT_LIGHT_COORDS ];
	varying vec4 vSpotLightCoord[ NUM_SPOT_LIGHT_COORDS ];
#endif
#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
		varying vec4 vSunShadowWorldPosition;
		varying vec3 vSunShadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		uniform mat4 directionalShadowMatrix[ NUM_DIR_LIGHT_SHADOWS ];
		varying vec4 vDirectionalShadowCoord[ NUM_DIR_LIGHT_SHADOWS ];
		struct DirectionalLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform DirectionalLightShadow directionalLightShadows[ NUM_DIR_LIGHT_SHADOWS ];
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
		struct SpotLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
		};
		uniform SpotLightShadow spotLightShadows[ NUM_SPOT_LIGHT_SHADOWS ];
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		uniform mat4 pointShadowMatrix[ NUM_POINT_LIGHT_SHADOWS ];
		varying vec4 vPointShadowCoord[ NUM_POINT_LIGHT_SHADOWS ];
		struct PointLightShadow {
			float shadowIntensity;
			float shadowBias;
			float shadowNormalBias;
			float shadowRadius;
			vec2 shadowMapSize;
			float shadowCameraNear;
			float shadowCameraFar;
		};
		uniform PointLightShadow pointLightShadows[ NUM_POINT_LIGHT_SHADOWS ];
	#endif
#endif`,ky=`#if ( defined( USE_SHADOWMAP ) && ( NUM_DIR_LIGHT_SHADOWS > 0 || NUM_SUN_LIGHT_SHADOWS > 0 || NUM_POINT_LIGHT_SHADOWS > 0 ) ) || ( NUM_SPOT_LIGHT_COORDS > 0 )
	#ifdef HAS_NORMAL
		vec3 shadowWorldNormal = transformNormalByInverseViewMatrix( transformedNormal, viewMatrix );
	#else
		vec3 shadowWorldNormal = vec3( 0.0 );
	#endif
	vec4 shadowWorldPosition;
#endif
#if defined( USE_SHADOWMAP )
	#if NUM_SUN_LIGHT_SHADOWS > 0
		vSunShadowWorldPosition = vec4( worldPosition.xyz, - mvPosition.z );
		vSunShadowWorldNormal = shadowWorldNormal;
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * directionalLightShadows[ i ].shadowNormalBias, 0 );
			vDirectionalShadowCoord[ i ] = directionalShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0
		#pragma unroll_loop_start
		for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
			shadowWorldPosition = worldPosition + vec4( shadowWorldNormal * pointLightShadows[ i ].shadowNormalBias, 0 );
			vPointShadowCoord[ i ] = pointShadowMatrix[ i ] * shadowWorldPosition;
		}
		#pragma unroll_loop_end
	#endif
#endif
#if NUM_SPOT_LIGHT_COORDS > 0
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_COORDS; i ++ ) {
		shadowWorldPosition = worldPosition;
		#if ( defined( USE_SHADOWMAP ) && UNROLLED_LOOP_INDEX < NUM_SPOT_LIGHT_SHADOWS )
			shadowWorldPosition.xyz += shadowWorldNormal * spotLightShadows[ i ].shadowNormalBias;
		#endif
		vSpotLightCoord[ i ] = spotLightMatrix[ i ] * shadowWorldPosition;
	}
	#pragma unroll_loop_end
#endif`,zy=`float getShadowMask() {
	float shadow = 1.0;
	#ifdef USE_SHADOWMAP
	#if NUM_SUN_LIGHT_SHADOWS > 0
	SunLightShadow sunLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SUN_LIGHT_SHADOWS; i ++ ) {
		sunLight = sunLightShadows[ i ];
		shadow *= receiveShadow ? getSunShadow( sunShadowMap[ i ], sunLight, UNROLLED_LOOP_INDEX ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_DIR_LIGHT_SHADOWS > 0
	DirectionalLightShadow directionalLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_DIR_LIGHT_SHADOWS; i ++ ) {
		directionalLight = directionalLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( directionalShadowMap[ i ], directionalLight.shadowMapSize, directionalLight.shadowIntensity, directionalLight.shadowBias, directionalLight.shadowRadius, vDirectionalShadowCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_SPOT_LIGHT_SHADOWS > 0
	SpotLightShadow spotLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_SPOT_LIGHT_SHADOWS; i ++ ) {
		spotLight = spotLightShadows[ i ];
		shadow *= receiveShadow ? getShadow( spotShadowMap[ i ], spotLight.shadowMapSize, spotLight.shadowIntensity, spotLight.shadowBias, spotLight.shadowRadius, vSpotLightCoord[ i ] ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#if NUM_POINT_LIGHT_SHADOWS > 0 && ( defined( SHADOWMAP_TYPE_PCF ) || defined( SHADOWMAP_TYPE_BASIC ) )
	PointLightShadow pointLight;
	#pragma unroll_loop_start
	for ( int i = 0; i < NUM_POINT_LIGHT_SHADOWS; i ++ ) {
		pointLight = pointLightShadows[ i ];
		shadow *= receiveShadow ? getPointShadow( pointShadowMap[ i ], pointLight.shadowMapSize, pointLight.shadowIntensity, pointLight.shadowBias, pointLight.shadowRadius, vPointShadowCoord[ i ], pointLight.shadowCameraNear, pointLight.shadowCameraFar ) : 1.0;
	}
	#pragma unroll_loop_end
	#endif
	#endif
	return shadow;
}`,Hy=`#ifdef USE_SKINNING
	mat4 boneMatX = getBoneMatrix( skinIndex.x );
	mat4 boneMatY = getBoneMatrix( skinIndex.y );
	mat4 boneMatZ = getBoneMatrix( skinIndex.z );
	mat4 boneMatW = getBoneMatrix( skinIndex.w );
#endif`,Gy=`#ifdef USE_SKINNING
	uniform mat4 bindMatrix;
	uniform mat4 bindMatrixInverse;
	uniform highp sampler2D boneTexture;
	mat4 getBoneMatrix( const in float i ) {
		int size = textureSize( boneTexture, 0 ).x;
		int j = int( i ) * 4;
		int x = j % size;
		int y = j / size;
		vec4 v1 = texelFetch( boneTexture, ivec2( x, y ), 0 );
		vec4 v2 = texelFetch( boneTexture, ivec2( x + 1, y ), 0 );
		vec4 v3 = texelFetch( boneTexture, ivec2( x + 2, y ), 0 );
		vec4 v4 = texelFetch( boneTexture, ivec2( x + 3, y ), 0 );
		return mat4( v1, v2, v3, v4 );
	}
#endif`,Vy=`#ifdef USE_SKINNING
	vec4 skinVertex = bindMatrix * vec4( transformed, 1.0 );
	vec4 skinned = vec4( 0.0 );
	skinned += boneMatX * skinVertex * skinWeight.x;
	skinned += boneMatY * skinVertex * skinWeight.y;
	skinned += boneMatZ * skinVertex * skinWeight.z;
	skinned += boneMatW * skinVertex * skinWeight.w;
	transformed = ( bindMatrixInverse * skinned ).xyz;
#endif`,Wy=`#ifdef USE_SKINNING
	mat4 skinMatrix = mat4( 0.0 );
	skinMatrix += skinWeight.x * boneMatX;
	skinMatrix += skinWeight.y * boneMatY;
	skinMatrix += skinWeight.z * boneMatZ;
	skinMatrix += skinWeight.w * boneMatW;
	skinMatrix = bindMatrixInverse * skinMatrix * bindMatrix;
	objectNormal = vec4( skinMatrix * vec4( objectNormal, 0.0 ) ).xyz;
	#ifdef USE_TANGENT
		objectTangent = vec4( skinMatrix * vec4( objectTangent, 0.0 ) ).xyz;
	#endif
#endif`,Xy=`float specularStrength;
#ifdef USE_SPECULARMAP
	vec4 texelSpecular = texture2D( specularMap, vSpecularMapUv );
	specularStrength = texelSpecular.r;
#else
	specularStrength = 1.0;
#endif`,qy=`#ifdef USE_SPECULARMAP
	uniform sampler2D specularMap;
#endif`,Yy=`#if defined( TONE_MAPPING )
	gl_FragColor.rgb = toneMapping( gl_FragColor.rgb );
#endif`,$y=`#ifndef saturate
#define saturate( a ) clamp( a, 0.0, 1.0 )
#endif
uniform float toneMappingExposure;
vec3 LinearToneMapping( vec3 color ) {
	return saturate( toneMappingExposure * color );
}
vec3 ReinhardToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	return saturate( color / ( vec3( 1.0 ) + color ) );
}
vec3 CineonToneMapping( vec3 color ) {
	color *= toneMappingExposure;
	color = max( vec3( 0.0 ), color - 0.004 );
	return pow( ( color * ( 6.2 * color + 0.5 ) ) / ( color * ( 6.2 * color + 1.7 ) + 0.06 ), vec3( 2.2 ) );
}
vec3 RRTAndODTFit( vec3 v ) {
	vec3 a = v * ( v + 0.0245786 ) - 0.000090537;
	vec3 b = v * ( 0.983729 * v + 0.4329510 ) + 0.238081;
	return a / b;
}
vec3 ACESFilmicToneMapping( vec3 color ) {
	const mat3 ACESInputMat = mat3(
		vec3( 0.59719, 0.07600, 0.02840 ),		vec3( 0.35458, 0.90834, 0.13383 ),
		vec3( 0.04823, 0.01566, 0.83777 )
	);
	const mat3 ACESOutputMat = mat3(
		vec3(  1.60475, -0.10208, -0.00327 ),		vec3( -0.53108,  1.10813, -0.07276 ),
		vec3( -0.07367, -0.00605,  1.07602 )
	);
	color *= toneMappingExposure / 0.6;
	color = ACESInputMat * color;
	color = RRTAndODTFit( color );
	color = ACESOutputMat * color;
	return saturate( color );
}
const mat3 LINEAR_REC2020_TO_LINEAR_SRGB = mat3(
	vec3( 1.6605, - 0.1246, - 0.0182 ),
	vec3( - 0.5876, 1.1329, - 0.1006 ),
	vec3( - 0.0728, - 0.0083, 1.1187 )
);
const mat3 LINEAR_SRGB_TO_LINEAR_REC2020 = mat3(
	vec3( 0.6274, 0.0691, 0.0164 ),
	vec3( 0.3293, 0.9195, 0.0880 ),
	vec3( 0.0433, 0.0113, 0.8956 )
);
vec3 agxDefaultContrastApprox( vec3 x ) {
	vec3 x2 = x * x;
	vec3 x4 = x2 * x2;
	return + 15.5 * x4 * x2
		- 40.14 * x4 * x
		+ 31.96 * x4
		- 6.868 * x2 * x
		+ 0.4298 * x2
		+ 0.1191 * x
		- 0.00232;
}
vec3 AgXToneMapping( vec3 color ) {
	const mat3 AgXInsetMatrix = mat3(
		vec3( 0.856627153315983, 0.137318972929847, 0.11189821299995 ),
		vec3( 0.0951212405381588, 0.761241990602591, 0.0767994186031903 ),
		vec3( 0.0482516061458583, 0.101439036467562, 0.811302368396859 )
	);
	const mat3 AgXOutsetMatrix = mat3(
		vec3( 1.1271005818144368, - 0.1413297634984383, - 0.14132976349843826 ),
		vec3( - 0.11060664309660323, 1.157823702216272, - 0.11060664309660294 ),
		vec3( - 0.016493938717834573, - 0.016493938717834257, 1.2519364065950405 )
	);
	const float AgxMinEv = - 12.47393;	const float AgxMaxEv = 4.026069;
	color *= toneMappingExposure;
	color = LINEAR_SRGB_TO_LINEAR_REC2020 * color;
	color = AgXInsetMatrix * color;
	color = max( color, 1e-10 );	color = log2( color );
	color = ( color - AgxMinEv ) / ( AgxMaxEv - AgxMinEv );
	color = clamp( color, 0.0, 1.0 );
	color = agxDefaultContrastApprox( color );
	color = AgXOutsetMatrix * color;
	color = pow( max( vec3( 0.0 ), color ), vec3( 2.2 ) );
	color = LINEAR_REC2020_TO_LINEAR_SRGB * color;
	color = clamp( color, 0.0, 1.0 );
	return color;
}
vec3 NeutralToneMapping( vec3 color ) {
	const float StartCompression = 0.8 - 0.04;
	const float Desaturation = 0.15;
	color *= toneMappingExposure;
	float x = min( color.r, min( color.g, color.b ) );
	float offset = x < 0.08 ? x - 6.25 * x * x : 0.04;
	color -= offset;
	float peak = max( color.r, max( color.g, color.b ) );
	if ( peak < StartCompression ) return color;
	float d = 1. - StartCompression;
	float newPeak = 1. - d * d / ( peak + d - StartCompression );
	color *= newPeak / peak;
	float g = 1. - 1. / ( Desaturation * ( peak - newPeak ) + 1. );
	return mix( color, vec3( newPeak ), g );
}
vec3 CustomToneMapping( vec3 color ) { return color; }`,Zy=`#ifdef USE_TRANSMISSION
	material.transmission = transmission;
	material.transmissionAlpha = 1.0;
	material.thickness = thickness;
	material.attenuationDistance = attenuationDistance;
	material.attenuationColor = attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		material.transmission *= texture2D( transmissionMap, vTransmissionMapUv ).r;
	#endif
	#ifdef USE_THICKNESSMAP
		material.thickness *= texture2D( thicknessMap, vThicknessMapUv ).g;
	#endif
	vec3 pos = vWorldPosition;
	vec3 v = normalize( cameraPosition - pos );
	vec3 n = transformNormalByInverseViewMatrix( normal, viewMatrix );
	vec4 transmitted = getIBLVolumeRefraction(
		n, v, material.roughness, material.diffuseContribution, material.specularColorBlended, material.specularF90,
		pos, modelMatrix, viewMatrix, projectionMatrix, material.dispersion, material.ior, material.thickness,
		material.attenuationColor, material.attenuationDistance );
	material.transmissionAlpha = mix( material.transmissionAlpha, transmitted.a, material.transmission );
	totalDiffuse = mix( totalDiffuse, transmitted.rgb, material.transmission );
#endif`,Jy=`#ifdef USE_TRANSMISSION
	uniform float transmission;
	uniform float thickness;
	uniform float attenuationDistance;
	uniform vec3 attenuationColor;
	#ifdef USE_TRANSMISSIONMAP
		uniform sampler2D transmissionMap;
	#endif
	#ifdef USE_THICKNESSMAP
		uniform sampler2D thicknessMap;
	#endif
	uniform vec2 transmissionSamplerSize;
	uniform sampler2D transmissionSamplerMap;
	uniform mat4 modelMatrix;
	uniform mat4 projectionMatrix;
	varying vec3 vWorldPosition;
	float w0( float a ) {
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - a + 3.0 ) - 3.0 ) + 1.0 );
	}
	float w1( float a ) {
		return ( 1.0 / 6.0 ) * ( a *  a * ( 3.0 * a - 6.0 ) + 4.0 );
	}
	float w2( float a ){
		return ( 1.0 / 6.0 ) * ( a * ( a * ( - 3.0 * a + 3.0 ) + 3.0 ) + 1.0 );
	}
	float w3( float a ) {
		return ( 1.0 / 6.0 ) * ( a * a * a );
	}
	float g0( float a ) {
		return w0( a ) + w1( a );
	}
	float g1( float a ) {
		return w2( a ) + w3( a );
	}
	float h0( float a ) {
		return - 1.0 + w1( a ) / ( w0( a ) + w1( a ) );
	}
	float h1( float a ) {
		return 1.0 + w3( a ) / ( w2( a ) + w3( a ) );
	}
	vec4 bicubic( sampler2D tex, vec2 uv, vec4 texelSize, float lod ) {
		uv = uv * texelSize.zw + 0.5;
		vec2 iuv = floor( uv );
		vec2 fuv = fract( uv );
		float g0x = g0( fuv.x );
		float g1x = g1( fuv.x );
		float h0x = h0( fuv.x );
		float h1x = h1( fuv.x );
		float h0y = h0( fuv.y );
		float h1y = h1( fuv.y );
		vec2 p0 = ( vec2( iuv.x + h0x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p1 = ( vec2( iuv.x + h1x, iuv.y + h0y ) - 0.5 ) * texelSize.xy;
		vec2 p2 = ( vec2( iuv.x + h0x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		vec2 p3 = ( vec2( iuv.x + h1x, iuv.y + h1y ) - 0.5 ) * texelSize.xy;
		return g0( fuv.y ) * ( g0x * textureLod( tex, p0, lod ) + g1x * textureLod( tex, p1, lod ) ) +
			g1( fuv.y ) * ( g0x * textureLod( tex, p2, lod ) + g1x * textureLod( tex, p3, lod ) );
	}
	vec4 textureBicubic( sampler2D sampler, vec2 uv, float lod ) {
		vec2 fLodSize = vec2( textureSize( sampler, int( lod ) ) );
		vec2 cLodSize = vec2( textureSize( sampler, int( lod + 1.0 ) ) );
		vec2 fLodSizeInv = 1.0 / fLodSize;
		vec2 cLodSizeInv = 1.0 / cLodSize;
		vec4 fSample = bicubic( sampler, uv, vec4( fLodSizeInv, fLodSize ), floor( lod ) );
		vec4 cSample = bicubic( sampler, uv, vec4( cLodSizeInv, cLodSize ), ceil( lod ) );
		return mix( fSample, cSample, fract( lod ) );
	}
	vec3 getVolumeTransmissionRay( const in vec3 n, const in vec3 v, const in float thickness, const in float ior, const in mat4 modelMatrix ) {
		vec3 refractionVector = refract( - v, normalize( n ), 1.0 / ior );
		vec3 modelScale;
		modelScale.x = length( vec3( modelMatrix[ 0 ].xyz ) );
		modelScale.y = length( vec3( modelMatrix[ 1 ].xyz ) );
		modelScale.z = length( vec3( modelMatrix[ 2 ].xyz ) );
		return normalize( refractionVector ) * thickness * modelScale;
	}
	float applyIorToRoughness( const in float roughness, const in float ior ) {
		return roughness * clamp( ior * 2.0 - 2.0, 0.0, 1.0 );
	}
	vec4 getTransmissionSample( const in vec2 fragCoord, const in float roughness, const in float ior ) {
		float lod = log2( transmissionSamplerSize.x ) * applyIorToRoughness( roughness, ior );
		return textureBicubic( transmissionSamplerMap, fragCoord.xy, lod );
	}
	vec3 volumeAttenuation( const in float transmissionDistance, const in vec3 attenuationColor, const in float attenuationDistance ) {
		if ( isinf( attenuationDistance ) ) {
			return vec3( 1.0 );
		} else {
			vec3 attenuationCoefficient = -log( attenuationColor ) / attenuationDistance;
			vec3 transmittance = exp( - attenuationCoefficient * transmissionDistance );			return transmittance;
		}
	}
	vec4 getIBLVolumeRefraction( const in vec3 n, const in vec3 v, const in float roughness, const in vec3 diffuseColor,
		const in vec3 specularColor, const in float specularF90, const in vec3 position, const in mat4 modelMatrix,
		const in mat4 viewMatrix, const in mat4 projMatrix, const in float dispersion, const in float ior, const in float thickness,
		const in vec3 attenuationColor, const in float attenuationDistance ) {
		vec4 transmittedLight;
		vec3 transmittance;
		#ifdef USE_DISPERSION
			float halfSpread = ( ior - 1.0 ) * 0.025 * dispersion;
			vec3 iors = vec3( ior - halfSpread, ior, ior + halfSpread );
			for ( int i = 0; i < 3; i ++ ) {
				vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, iors[ i ], modelMatrix );
				vec3 refractedRayExit = position + transmissionRay;
				vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
				vec2 refractionCoords = ndcPos.xy / ndcPos.w;
				refractionCoords += 1.0;
				refractionCoords /= 2.0;
				vec4 transmissionSample = getTransmissionSample( refractionCoords, roughness, iors[ i ] );
				transmittedLight[ i ] = transmissionSample[ i ];
				transmittedLight.a += transmissionSample.a;
				transmittance[ i ] = diffuseColor[ i ] * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance )[ i ];
			}
			transmittedLight.a /= 3.0;
		#else
			vec3 transmissionRay = getVolumeTransmissionRay( n, v, thickness, ior, modelMatrix );
			vec3 refractedRayExit = position + transmissionRay;
			vec4 ndcPos = projMatrix * viewMatrix * vec4( refractedRayExit, 1.0 );
			vec2 refractionCoords = ndcPos.xy / ndcPos.w;
			refractionCoords += 1.0;
			refractionCoords /= 2.0;
			transmittedLight = getTransmissionSample( refractionCoords, roughness, ior );
			transmittance = diffuseColor * volumeAttenuation( length( transmissionRay ), attenuationColor, attenuationDistance );
		#endif
		vec3 attenuatedColor = transmittance * transmittedLight.rgb;
		vec3 F = EnvironmentBRDF( n, v, specularColor, specularF90, roughness );
		float transmittanceFactor = ( transmittance.r + transmittance.g + transmittance.b ) / 3.0;
		return vec4( ( 1.0 - F ) * attenuatedColor, 1.0 - ( 1.0 - transmittedLight.a ) * transmittanceFactor );
	}
#endif`,Ky=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_SPECULARMAP
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,Qy=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	varying vec2 vUv;
#endif
#ifdef USE_MAP
	uniform mat3 mapTransform;
	varying vec2 vMapUv;
#endif
#ifdef USE_ALPHAMAP
	uniform mat3 alphaMapTransform;
	varying vec2 vAlphaMapUv;
#endif
#ifdef USE_LIGHTMAP
	uniform mat3 lightMapTransform;
	varying vec2 vLightMapUv;
#endif
#ifdef USE_AOMAP
	uniform mat3 aoMapTransform;
	varying vec2 vAoMapUv;
#endif
#ifdef USE_BUMPMAP
	uniform mat3 bumpMapTransform;
	varying vec2 vBumpMapUv;
#endif
#ifdef USE_NORMALMAP
	uniform mat3 normalMapTransform;
	varying vec2 vNormalMapUv;
#endif
#ifdef USE_DISPLACEMENTMAP
	uniform mat3 displacementMapTransform;
	varying vec2 vDisplacementMapUv;
#endif
#ifdef USE_EMISSIVEMAP
	uniform mat3 emissiveMapTransform;
	varying vec2 vEmissiveMapUv;
#endif
#ifdef USE_METALNESSMAP
	uniform mat3 metalnessMapTransform;
	varying vec2 vMetalnessMapUv;
#endif
#ifdef USE_ROUGHNESSMAP
	uniform mat3 roughnessMapTransform;
	varying vec2 vRoughnessMapUv;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	uniform mat3 diffuseRoughnessMapTransform;
	varying vec2 vDiffuseRoughnessMapUv;
#endif
#ifdef USE_ANISOTROPYMAP
	uniform mat3 anisotropyMapTransform;
	varying vec2 vAnisotropyMapUv;
#endif
#ifdef USE_CLEARCOATMAP
	uniform mat3 clearcoatMapTransform;
	varying vec2 vClearcoatMapUv;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	uniform mat3 clearcoatNormalMapTransform;
	varying vec2 vClearcoatNormalMapUv;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	uniform mat3 clearcoatRoughnessMapTransform;
	varying vec2 vClearcoatRoughnessMapUv;
#endif
#ifdef USE_SHEEN_COLORMAP
	uniform mat3 sheenColorMapTransform;
	varying vec2 vSheenColorMapUv;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	uniform mat3 sheenRoughnessMapTransform;
	varying vec2 vSheenRoughnessMapUv;
#endif
#ifdef USE_IRIDESCENCEMAP
	uniform mat3 iridescenceMapTransform;
	varying vec2 vIridescenceMapUv;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	uniform mat3 iridescenceThicknessMapTransform;
	varying vec2 vIridescenceThicknessMapUv;
#endif
#ifdef USE_SPECULARMAP
	uniform mat3 specularMapTransform;
	varying vec2 vSpecularMapUv;
#endif
#ifdef USE_SPECULAR_COLORMAP
	uniform mat3 specularColorMapTransform;
	varying vec2 vSpecularColorMapUv;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	uniform mat3 specularIntensityMapTransform;
	varying vec2 vSpecularIntensityMapUv;
#endif
#ifdef USE_TRANSMISSIONMAP
	uniform mat3 transmissionMapTransform;
	varying vec2 vTransmissionMapUv;
#endif
#ifdef USE_THICKNESSMAP
	uniform mat3 thicknessMapTransform;
	varying vec2 vThicknessMapUv;
#endif`,jy=`#if defined( USE_UV ) || defined( USE_ANISOTROPY )
	vUv = vec3( uv, 1 ).xy;
#endif
#ifdef USE_MAP
	vMapUv = ( mapTransform * vec3( MAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ALPHAMAP
	vAlphaMapUv = ( alphaMapTransform * vec3( ALPHAMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_LIGHTMAP
	vLightMapUv = ( lightMapTransform * vec3( LIGHTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_AOMAP
	vAoMapUv = ( aoMapTransform * vec3( AOMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_BUMPMAP
	vBumpMapUv = ( bumpMapTransform * vec3( BUMPMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_NORMALMAP
	vNormalMapUv = ( normalMapTransform * vec3( NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DISPLACEMENTMAP
	vDisplacementMapUv = ( displacementMapTransform * vec3( DISPLACEMENTMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_EMISSIVEMAP
	vEmissiveMapUv = ( emissiveMapTransform * vec3( EMISSIVEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_METALNESSMAP
	vMetalnessMapUv = ( metalnessMapTransform * vec3( METALNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ROUGHNESSMAP
	vRoughnessMapUv = ( roughnessMapTransform * vec3( ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_DIFFUSE_ROUGHNESSMAP
	vDiffuseRoughnessMapUv = ( diffuseRoughnessMapTransform * vec3( DIFFUSE_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_ANISOTROPYMAP
	vAnisotropyMapUv = ( anisotropyMapTransform * vec3( ANISOTROPYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOATMAP
	vClearcoatMapUv = ( clearcoatMapTransform * vec3( CLEARCOATMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_NORMALMAP
	vClearcoatNormalMapUv = ( clearcoatNormalMapTransform * vec3( CLEARCOAT_NORMALMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_CLEARCOAT_ROUGHNESSMAP
	vClearcoatRoughnessMapUv = ( clearcoatRoughnessMapTransform * vec3( CLEARCOAT_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCEMAP
	vIridescenceMapUv = ( iridescenceMapTransform * vec3( IRIDESCENCEMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_IRIDESCENCE_THICKNESSMAP
	vIridescenceThicknessMapUv = ( iridescenceThicknessMapTransform * vec3( IRIDESCENCE_THICKNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_COLORMAP
	vSheenColorMapUv = ( sheenColorMapTransform * vec3( SHEEN_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SHEEN_ROUGHNESSMAP
	vSheenRoughnessMapUv = ( sheenRoughnessMapTransform * vec3( SHEEN_ROUGHNESSMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULARMAP
	vSpecularMapUv = ( specularMapTransform * vec3( SPECULARMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_COLORMAP
	vSpecularColorMapUv = ( specularColorMapTransform * vec3( SPECULAR_COLORMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_SPECULAR_INTENSITYMAP
	vSpecularIntensityMapUv = ( specularIntensityMapTransform * vec3( SPECULAR_INTENSITYMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_TRANSMISSIONMAP
	vTransmissionMapUv = ( transmissionMapTransform * vec3( TRANSMISSIONMAP_UV, 1 ) ).xy;
#endif
#ifdef USE_THICKNESSMAP
	vThicknessMapUv = ( thicknessMapTransform * vec3( THICKNESSMAP_UV, 1 ) ).xy;
#endif`,eS=`#if defined( USE_ENVMAP ) || defined( DISTANCE ) || defined ( USE_SHADOWMAP ) || defined ( USE_TRANSMISSION ) || NUM_SPOT_LIGHT_COORDS > 0
	vec4 worldPosition = vec4( transformed, 1.0 );
	#ifdef USE_BATCHING
		worldPosition = batchingMatrix * worldPosition;
	#endif
	#ifdef USE_INSTANCING
		worldPosition = instanceMatrix * worldPosition;
	#endif
	worldPosition = modelMatrix * worldPosition;
#endif`,tS=`varying vec2 vUv;
uniform mat3 uvTransform;
void main() {
	vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	gl_Position = vec4( position.xy, 1.0, 1.0 );
}`,nS=`uniform sampler2D t2D;
uniform float backgroundIntensity;
varying vec2 vUv;
void main() {
	vec4 texColor = texture2D( t2D, vUv );
	#ifdef DECODE_VIDEO_TEXTURE
		texColor = vec4( mix( pow( texColor.rgb * 0.9478672986 + vec3( 0.0521327014 ), vec3( 2.4 ) ), texColor.rgb * 0.0773993808, vec3( lessThanEqual( texColor.rgb, vec3( 0.04045 ) ) ) ), texColor.w );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,iS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,sS=`uniform float backgroundBlurriness;
uniform float backgroundIntensity;
uniform mat3 backgroundRotation;
varying vec3 vWorldDirection;
#include <envmap_common_pars_fragment>
void main() {
	#ifdef ENVMAP_TYPE_PMREM
		vec4 texColor = textureLod( envMap, backgroundRotation * vWorldDirection, roughnessToMip( backgroundBlurriness ) );
	#else
		vec4 texColor = textureCube( envMap, backgroundRotation * vWorldDirection );
	#endif
	texColor.rgb *= backgroundIntensity;
	gl_FragColor = texColor;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,rS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
	gl_Position.z = gl_Position.w;
}`,oS=`uniform samplerCube tCube;
uniform float tFlip;
uniform float opacity;
varying vec3 vWorldDirection;
void main() {
	vec4 texColor = textureCube( tCube, vec3( tFlip * vWorldDirection.x, vWorldDirection.yz ) );
	gl_FragColor = texColor;
	gl_FragColor.a *= opacity;
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,aS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
varying vec2 vHighPrecisionZW;
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vHighPrecisionZW = gl_Position.zw;
}`,lS=`#if DEPTH_PACKING == 3200
	uniform float opacity;
#endif
#include <common>
#include <packing>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
varying vec2 vHighPrecisionZW;
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#if DEPTH_PACKING == 3200
		diffuseColor.a = opacity;
	#endif
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <logdepthbuf_fragment>
	#ifdef USE_REVERSED_DEPTH_BUFFER
		float fragCoordZ = vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ];
	#else
		float fragCoordZ = 0.5 * vHighPrecisionZW[ 0 ] / vHighPrecisionZW[ 1 ] + 0.5;
	#endif
	#if DEPTH_PACKING == 3200
		gl_FragColor = vec4( vec3( 1.0 - fragCoordZ ), opacity );
	#elif DEPTH_PACKING == 3201
		gl_FragColor = packDepthToRGBA( fragCoordZ );
	#elif DEPTH_PACKING == 3202
		gl_FragColor = vec4( packDepthToRGB( fragCoordZ ), 1.0 );
	#elif DEPTH_PACKING == 3203
		gl_FragColor = vec4( packDepthToRG( fragCoordZ ), 0.0, 1.0 );
	#endif
}`,cS=`#define DISTANCE
varying vec3 vWorldPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <skinbase_vertex>
	#include <morphinstance_vertex>
	#ifdef USE_DISPLACEMENTMAP
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <worldpos_vertex>
	#include <clipping_planes_vertex>
	vWorldPosition = worldPosition.xyz;
}`,hS=`#define DISTANCE
uniform vec3 referencePosition;
uniform float nearDistance;
uniform float farDistance;
varying vec3 vWorldPosition;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 1.0 );
	#include <clipping_planes_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	float dist = length( vWorldPosition - referencePosition );
	dist = ( dist - nearDistance ) / ( farDistance - nearDistance );
	dist = saturate( dist );
	gl_FragColor = vec4( dist, 0.0, 0.0, 1.0 );
}`,uS=`varying vec3 vWorldDirection;
#include <common>
void main() {
	vWorldDirection = transformDirection( position, modelMatrix );
	#include <begin_vertex>
	#include <project_vertex>
}`,dS=`uniform sampler2D tEquirect;
varying vec3 vWorldDirection;
#include <common>
void main() {
	vec3 direction = normalize( vWorldDirection );
	vec2 sampleUV = equirectUv( direction );
	gl_FragColor = texture2D( tEquirect, sampleUV );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
}`,fS=`uniform float scale;
attribute float lineDistance;
varying float vLineDistance;
#include <common>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	vLineDistance = scale * lineDistance;
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,pS=`uniform vec3 diffuse;
uniform float opacity;
uniform float dashSize;
uniform float totalSize;
varying float vLineDistance;
#include <common>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	if ( mod( vLineDistance, totalSize ) > dashSize ) {
		discard;
	}
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,mS=`#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#if defined ( USE_ENVMAP ) || defined ( USE_SKINNING )
		#include <beginnormal_vertex>
		#include <morphnormal_vertex>
		#include <skinbase_vertex>
		#include <skinnormal_vertex>
		#include <defaultnormal_vertex>
	#endif
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <fog_vertex>
}`,gS=`uniform vec3 diffuse;
uniform float opacity;
#ifndef FLAT_SHADED
	varying vec3 vNormal;
#endif
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <fog_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	#ifdef USE_LIGHTMAP
		vec4 lightMapTexel = texture2D( lightMap, vLightMapUv );
		reflectedLight.indirectDiffuse += lightMapTexel.rgb * lightMapIntensity * RECIPROCAL_PI;
	#else
		reflectedLight.indirectDiffuse += vec3( 1.0 );
	#endif
	#include <aomap_fragment>
	reflectedLight.indirectDiffuse *= diffuseColor.rgb;
	vec3 outgoingLight = reflectedLight.indirectDiffuse;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,_S=`#define LAMBERT
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,vS=`#define LAMBERT
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_lambert_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_lambert_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,xS=`#define MATCAP
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <color_pars_vertex>
#include <displacementmap_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
	vViewPosition = - mvPosition.xyz;
}`,yS=`#define MATCAP
uniform vec3 diffuse;
uniform float opacity;
uniform sampler2D matcap;
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	vec3 viewDir = normalize( vViewPosition );
	vec3 x = normalize( vec3( viewDir.z, 0.0, - viewDir.x ) );
	vec3 y = cross( viewDir, x );
	vec2 uv = vec2( dot( x, normal ), dot( y, normal ) ) * 0.495 + 0.5;
	#ifdef USE_MATCAP
		vec4 matcapColor = texture2D( matcap, uv );
	#else
		vec4 matcapColor = vec4( vec3( mix( 0.2, 0.8, uv.y ) ), 1.0 );
	#endif
	vec3 outgoingLight = diffuseColor.rgb * matcapColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,SS=`#define NORMAL
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	vViewPosition = - mvPosition.xyz;
#endif
}`,MS=`#define NORMAL
uniform float opacity;
#if defined( FLAT_SHADED ) || defined( USE_BUMPMAP ) || defined( USE_NORMALMAP_TANGENTSPACE )
	varying vec3 vViewPosition;
#endif
#include <uv_pars_fragment>
#include <normal_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( 0.0, 0.0, 0.0, opacity );
	#include <clipping_planes_fragment>
	#include <logdepthbuf_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	gl_FragColor = vec4( normalize( normal ) * 0.5 + 0.5, diffuseColor.a );
	#ifdef OPAQUE
		gl_FragColor.a = 1.0;
	#endif
}`,bS=`#define PHONG
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <envmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <envmap_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,wS=`#define PHONG
uniform vec3 diffuse;
uniform vec3 emissive;
uniform vec3 specular;
uniform float shininess;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_phong_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <specularmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <specularmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_phong_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + reflectedLight.directSpecular + reflectedLight.indirectSpecular + totalEmissiveRadiance;
	#include <envmap_fragment>
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,ES=`#define STANDARD
varying vec3 vViewPosition;
#ifdef USE_TRANSMISSION
	varying vec3 vWorldPosition;
#endif
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
#ifdef USE_TRANSMISSION
	vWorldPosition = worldPosition.xyz;
#endif
}`,TS=`#define STANDARD
#ifdef PHYSICAL
	#define IOR
	#define USE_SPECULAR
#endif
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float roughness;
uniform float metalness;
uniform float opacity;
#ifdef IOR
	uniform float ior;
#endif
#ifdef USE_SPECULAR
	uniform float specularIntensity;
	uniform vec3 specularColor;
	#ifdef USE_SPECULAR_COLORMAP
		uniform sampler2D specularColorMap;
	#endif
	#ifdef USE_SPECULAR_INTENSITYMAP
		uniform sampler2D specularIntensityMap;
	#endif
#endif
#ifdef USE_CLEARCOAT
	uniform float clearcoat;
	uniform float clearcoatRoughness;
#endif
#ifdef USE_DIFFUSE_ROUGHNESS
	uniform float diffuseRoughness;
	#ifdef USE_DIFFUSE_ROUGHNESSMAP
		uniform sampler2D diffuseRoughnessMap;
	#endif
#endif
#ifdef USE_DISPERSION
	uniform float dispersion;
#endif
#ifdef USE_RETROREFLECTION
	uniform float retroreflectivity;
#endif
#ifdef USE_IRIDESCENCE
	uniform float iridescence;
	uniform float iridescenceIOR;
	uniform float iridescenceThicknessMinimum;
	uniform float iridescenceThicknessMaximum;
#endif
#ifdef USE_SHEEN
	uniform vec3 sheenColor;
	uniform float sheenRoughness;
	#ifdef USE_SHEEN_COLORMAP
		uniform sampler2D sheenColorMap;
	#endif
	#ifdef USE_SHEEN_ROUGHNESSMAP
		uniform sampler2D sheenRoughnessMap;
	#endif
#endif
#ifdef USE_ANISOTROPY
	uniform vec2 anisotropyVector;
	#ifdef USE_ANISOTROPYMAP
		uniform sampler2D anisotropyMap;
	#endif
#endif
varying vec3 vViewPosition;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <iridescence_fragment>
#include <envmap_common_pars_fragment>
#include <envmap_physical_pars_fragment>
#include <fog_pars_fragment>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_physical_pars_fragment>
#include <transmission_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <clearcoat_pars_fragment>
#include <iridescence_pars_fragment>
#include <roughnessmap_pars_fragment>
#include <metalnessmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <roughnessmap_fragment>
	#include <metalnessmap_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <clearcoat_normal_fragment_begin>
	#include <clearcoat_normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_physical_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 totalDiffuse = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse;
	vec3 totalSpecular = reflectedLight.directSpecular + reflectedLight.indirectSpecular;
	#include <transmission_fragment>
	vec3 outgoingLight = totalDiffuse + totalSpecular + totalEmissiveRadiance;
	#ifdef USE_SHEEN
 
		outgoingLight = outgoingLight + sheenSpecularDirect + sheenSpecularIndirect;
 
 	#endif
	#ifdef USE_CLEARCOAT
		float dotNVcc = saturate( dot( geometryClearcoatNormal, geometryViewDir ) );
		vec3 Fcc = F_Schlick( material.clearcoatF0, material.clearcoatF90, dotNVcc );
		outgoingLight = outgoingLight * ( 1.0 - material.clearcoat * Fcc ) + ( clearcoatSpecularDirect + clearcoatSpecularIndirect ) * material.clearcoat;
	#endif
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,AS=`#define TOON
varying vec3 vViewPosition;
#include <common>
#include <batching_pars_vertex>
#include <uv_pars_vertex>
#include <displacementmap_pars_vertex>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <normal_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <shadowmap_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <normal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <displacementmap_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	vViewPosition = - mvPosition.xyz;
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,RS=`#define TOON
uniform vec3 diffuse;
uniform vec3 emissive;
uniform float opacity;
#include <common>
#include <dithering_pars_fragment>
#include <color_pars_fragment>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <aomap_pars_fragment>
#include <lightmap_pars_fragment>
#include <emissivemap_pars_fragment>
#include <gradientmap_pars_fragment>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <normal_pars_fragment>
#include <lights_toon_pars_fragment>
#include <shadowmap_pars_fragment>
#include <bumpmap_pars_fragment>
#include <normalmap_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	ReflectedLight reflectedLight = ReflectedLight( vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ), vec3( 0.0 ) );
	vec3 totalEmissiveRadiance = emissive;
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <color_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	#include <normal_fragment_begin>
	#include <normal_fragment_maps>
	#include <emissivemap_fragment>
	#include <lights_toon_fragment>
	#include <lights_fragment_begin>
	#include <lights_fragment_maps>
	#include <lights_fragment_end>
	#include <aomap_fragment>
	vec3 outgoingLight = reflectedLight.directDiffuse + reflectedLight.indirectDiffuse + totalEmissiveRadiance;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
	#include <dithering_fragment>
}`,CS=`uniform float size;
uniform float scale;
#include <common>
#include <color_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
#ifdef USE_POINTS_UV
	varying vec2 vUv;
	uniform mat3 uvTransform;
#endif
void main() {
	#ifdef USE_POINTS_UV
		vUv = ( uvTransform * vec3( uv, 1 ) ).xy;
	#endif
	#include <color_vertex>
	#include <morphinstance_vertex>
	#include <morphcolor_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <project_vertex>
	gl_PointSize = size;
	#ifdef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) gl_PointSize *= ( scale / - mvPosition.z );
	#endif
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <worldpos_vertex>
	#include <fog_vertex>
}`,PS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <color_pars_fragment>
#include <map_particle_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_particle_fragment>
	#include <color_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,IS=`#include <common>
#include <batching_pars_vertex>
#include <fog_pars_vertex>
#include <morphtarget_pars_vertex>
#include <skinning_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <shadowmap_pars_vertex>
void main() {
	#include <batching_vertex>
	#include <beginnormal_vertex>
	#include <morphinstance_vertex>
	#include <morphnormal_vertex>
	#include <skinbase_vertex>
	#include <skinnormal_vertex>
	#include <defaultnormal_vertex>
	#include <begin_vertex>
	#include <morphtarget_vertex>
	#include <skinning_vertex>
	#include <project_vertex>
	#include <logdepthbuf_vertex>
	#include <worldpos_vertex>
	#include <shadowmap_vertex>
	#include <fog_vertex>
}`,LS=`uniform vec3 color;
uniform float opacity;
#include <common>
#include <fog_pars_fragment>
#include <bsdfs>
#include <lights_pars_begin>
#include <logdepthbuf_pars_fragment>
#include <shadowmap_pars_fragment>
#include <shadowmask_pars_fragment>
void main() {
	#include <logdepthbuf_fragment>
	gl_FragColor = vec4( color, opacity * ( 1.0 - getShadowMask() ) );
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
	#include <premultiplied_alpha_fragment>
}`,DS=`uniform float rotation;
uniform vec2 center;
#include <common>
#include <uv_pars_vertex>
#include <fog_pars_vertex>
#include <logdepthbuf_pars_vertex>
#include <clipping_planes_pars_vertex>
void main() {
	#include <uv_vertex>
	vec4 mvPosition = modelViewMatrix[ 3 ];
	vec2 scale = vec2( length( modelMatrix[ 0 ].xyz ), length( modelMatrix[ 1 ].xyz ) );
	#ifndef USE_SIZEATTENUATION
		bool isPerspective = isPerspectiveMatrix( projectionMatrix );
		if ( isPerspective ) scale *= - mvPosition.z;
	#endif
	vec2 alignedPosition = ( position.xy - ( center - vec2( 0.5 ) ) ) * scale;
	vec2 rotatedPosition;
	rotatedPosition.x = cos( rotation ) * alignedPosition.x - sin( rotation ) * alignedPosition.y;
	rotatedPosition.y = sin( rotation ) * alignedPosition.x + cos( rotation ) * alignedPosition.y;
	mvPosition.xy += rotatedPosition;
	gl_Position = projectionMatrix * mvPosition;
	#include <logdepthbuf_vertex>
	#include <clipping_planes_vertex>
	#include <fog_vertex>
}`,NS=`uniform vec3 diffuse;
uniform float opacity;
#include <common>
#include <uv_pars_fragment>
#include <map_pars_fragment>
#include <alphamap_pars_fragment>
#include <alphatest_pars_fragment>
#include <alphahash_pars_fragment>
#include <fog_pars_fragment>
#include <logdepthbuf_pars_fragment>
#include <clipping_planes_pars_fragment>
void main() {
	vec4 diffuseColor = vec4( diffuse, opacity );
	#include <clipping_planes_fragment>
	vec3 outgoingLight = vec3( 0.0 );
	#include <logdepthbuf_fragment>
	#include <map_fragment>
	#include <alphamap_fragment>
	#include <alphatest_fragment>
	#include <alphahash_fragment>
	outgoingLight = diffuseColor.rgb;
	#include <opaque_fragment>
	#include <tonemapping_fragment>
	#include <colorspace_fragment>
	#include <fog_fragment>
}`,yt={alphahash_fragment:nx,alphahash_pars_fragment:ix,alphamap_fragment:sx,alphamap_pars_fragment:rx,alphatest_fragment:ox,alphatest_pars_fragment:ax,aomap_fragment:lx,aomap_pars_fragment:cx,batching_pars_vertex:hx,batching_vertex:ux,begin_vertex:dx,beginnormal_vertex:fx,bsdfs:px,iridescence_fragment:mx,bumpmap_pars_fragment:gx,clipping_planes_fragment:_x,clipping_planes_pars_fragment:vx,clipping_planes_pars_vertex:xx,clipping_planes_vertex:yx,color_fragment:Sx,color_pars_fragment:Mx,color_pars_vertex:bx,color_vertex:wx,common:Ex,defaultnormal_vertex:Tx,displacementmap_pars_vertex:Ax,displacementmap_vertex:Rx,emissivemap_fragment:Cx,emissivemap_pars_fragment:Px,colorspace_fragment:Ix,colorspace_pars_fragment:Lx,envmap_fragment:Dx,envmap_common_pars_fragment:Nx,envmap_pars_fragment:Ux,envmap_pars_vertex:Fx,envmap_physical_pars_fragment:Yx,envmap_vertex:Ox,fog_vertex:Bx,fog_pars_vertex:kx,fog_fragment:zx,fog_pars_fragment:Hx,gradientmap_pars_fragment:Gx,lightmap_pars_fragment:Vx,lights_lambert_fragment:Wx,lights_lambert_pars_fragment:Xx,lights_pars_begin:qx,lights_toon_fragment:$x,lights_toon_pars_fragment:Zx,lights_phong_fragment:Jx,lights_phong_pars_fragment:Kx,lights_physical_fragment:Qx,lights_physical_pars_fragment:jx,lights_fragment_begin:ey,lights_fragment_maps:ty,lights_fragment_end:ny,lightprobes_pars_fragment:iy,logdepthbuf_fragment:sy,logdepthbuf_pars_fragment:ry,logdepthbuf_pars_vertex:oy,logdepthbuf_vertex:ay,map_fragment:ly,map_pars_fragment:cy,map_particle_fragment:hy,map_particle_pars_fragment:uy,metalnessmap_fragment:dy,metalnessmap_pars_fragment:fy,morphinstance_vertex:py,morphcolor_vertex:my,morphnormal_vertex:gy,morphtarget_pars_vertex:_y,morphtarget_vertex:vy,normal_fragment_begin:xy,normal_fragment_maps:yy,normal_pars_fragment:Sy,normal_pars_vertex:My,normal_vertex:by,normalmap_pars_fragment:wy,clearcoat_normal_fragment_begin:Ey,clearcoat_normal_fragment_maps:Ty,clearcoat_pars_fragment:Ay,iridescence_pars_fragment:Ry,opaque_fragment:Cy,packing:Py,premultiplied_alpha_fragment:Iy,project_vertex:Ly,dithering_fragment:Dy,dithering_pars_fragment:Ny,roughnessmap_fragment:Uy,roughnessmap_pars_fragment:Fy,shadowmap_pars_fragment:Oy,shadowmap_pars_vertex:By,shadowmap_vertex:ky,shadowmask_pars_fragment:zy,skinbase_vertex:Hy,skinning_pars_vertex:Gy,skinning_vertex:Vy,skinnormal_vertex:Wy,specularmap_fragment:Xy,specularmap_pars_fragment:qy,tonemapping_fragment:Yy,tonemapping_pars_fragment:$y,transmission_fragment:Zy,transmission_pars_fragment:Jy,uv_pars_fragment:Ky,uv_pars_vertex:Qy,uv_vertex:jy,worldpos_vertex:eS,background_vert:tS,background_frag:nS,backgroundCube_vert:iS,backgroundCube_frag:sS,cube_vert:rS,cube_frag:oS,depth_vert:aS,depth_frag:lS,distance_vert:cS,distance_frag:hS,equirect_vert:uS,equirect_frag:dS,linedashed_vert:fS,linedashed_frag:pS,meshbasic_vert:mS,meshbasic_frag:gS,meshlambert_vert:_S,meshlambert_frag:vS,meshmatcap_vert:xS,meshmatcap_frag:yS,meshnormal_vert:SS,meshnormal_frag:MS,meshphong_vert:bS,meshphong_frag:wS,meshphysical_vert:ES,meshphysical_frag:TS,meshtoon_vert:AS,meshtoon_frag:RS,points_vert:CS,points_frag:PS,shadow_vert:IS,shadow_frag:LS,sprite_vert:DS,sprite_frag:NS},Oe={common:{diffuse:{value:new pt(16777215)},opacity:{value:1},map:{value:null},mapTransform:{value:new ft},alphaMap:{value:null},alphaMapTransform:{value:new ft},alphaTest:{value:0}},specularmap:{specularMap:{value:null},specularMapTransform:{value:new ft}},envmap:{envMap:{value:null},envMapRotation:{value:new ft},reflectivity:{value:1},ior:{value:1.5},refractionRatio:{value:.98},dfgLUT:{value:null}},aomap:{aoMap:{value:null},aoMapIntensity:{value:1},aoMapTransform:{value:new ft}},lightmap:{lightMap:{value:null},lightMapIntensity:{value:1},lightMapTransform:{value:new ft}},bumpmap:{bumpMap:{value:null},bumpMapTransform:{value:new ft},bumpScale:{value:1}},normalmap:{normalMap:{value:null},normalMapTransform:{value:new ft},normalScale:{value:new De(1,1)}},displacementmap:{displacementMap:{value:null},displacementMapTransform:{value:new ft},displacementScale:{value:1},displacementBias:{value:0}},emissivemap:{emissiveMap:{value:null},emissiveMapTransform:{value:new ft}},metalnessmap:{metalnessMap:{value:null},metalnessMapTransform:{value:new ft}},roughnessmap:{roughnessMap:{value:null},roughnessMapTransform:{value:new ft}},gradientmap:{gradientMap:{value:null}},fog:{fogDensity:{value:25e-5},fogNear:{value:1},fogFar:{value:2e3},fogColor:{value:new pt(16777215)}},lights:{ambientLightColor:{value:[]},lightProbe:{value:[]},sunLights:{value:[],properties:{direction:{},color:{}}},sunLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},sunShadowMatrix:{value:[]},sunShadowCascade:{value:[]},directionalLights:{value:[],properties:{direction:{},color:{}}},directionalLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},directionalShadowMatrix:{value:[]},spotLights:{value:[],properties:{color:{},position:{},direction:{},distance:{},coneCos:{},penumbraCos:{},decay:{}}},spotLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{}}},spotLightMap:{value:[]},spotLightMatrix:{value:[]},pointLights:{value:[],properties:{color:{},position:{},decay:{},distance:{}}},pointLightShadows:{value:[],properties:{shadowIntensity:1,shadowBias:{},shadowNormalBias:{},shadowRadius:{},shadowMapSize:{},shadowCameraNear:{},shadowCameraFar:{}}},pointShadowMatrix:{value:[]},hemisphereLights:{value:[],properties:{direction:{},skyColor:{},groundColor:{}}},rectAreaLights:{value:[],properties:{color:{},position:{},width:{},height:{}}},ltc_1:{value:null},ltc_2:{value:null},probesSH:{value:[]},probesMin:{value:[]},probesMax:{value:[]},probesResolution:{value:[]}},points:{diffuse:{value:new pt(16777215)},opacity:{value:1},size:{value:1},scale:{value:1},map:{value:null},alphaMap:{value:null},alphaMapTransform:{value:new ft},alphaTest:{value:0},uvTransform:{value:new ft}},sprite:{diffuse:{value:new pt(16777215)},opacity:{value:1},center:{value:new De(.5,.5)},rotation:{value:0},map:{value:null},mapTransform:{value:new ft},alphaMap:{value:null},alphaMapTransform:{value:new ft},alphaTest:{value:0}}},ji={basic:{uniforms:zn([Oe.common,Oe.specularmap,Oe.envmap,Oe.aomap,Oe.lightmap,Oe.fog]),vertexShader:yt.meshbasic_vert,fragmentShader:yt.meshbasic_frag},lambert:{uniforms:zn([Oe.common,Oe.specularmap,Oe.envmap,Oe.aomap,Oe.lightmap,Oe.emissivemap,Oe.bumpmap,Oe.normalmap,Oe.displacementmap,Oe.fog,Oe.lights,{emissive:{value:new pt(0)},envMapIntensity:{value:1}}]),vertexShader:yt.meshlambert_vert,fragmentShader:yt.meshlambert_frag},phong:{uniforms:zn([Oe.common,Oe.specularmap,Oe.envmap,Oe.aomap,Oe.lightmap,Oe.emissivemap,Oe.bumpmap,Oe.normalmap,Oe.displacementmap,Oe.fog,Oe.lights,{emissive:{value:new pt(0)},specular:{value:new pt(1118481)},shininess:{value:30},envMapIntensity:{value:1}}]),vertexShader:yt.meshphong_vert,fragmentShader:yt.meshphong_frag},standard:{uniforms:zn([Oe.common,Oe.envmap,Oe.aomap,Oe.lightmap,Oe.emissivemap,Oe.bumpmap,Oe.normalmap,Oe.displacementmap,Oe.roughnessmap,Oe.metalnessmap,Oe.fog,Oe.lights,{emissive:{value:new pt(0)},roughness:{value:1},metalness:{value:0},envMapIntensity:{value:1}}]),vertexShader:yt.meshphysical_vert,fragmentShader:yt.meshphysical_frag},toon:{uniforms:zn([Oe.common,Oe.aomap,Oe.lightmap,Oe.emissivemap,Oe.bumpmap,Oe.normalmap,Oe.displacementmap,Oe.gradientmap,Oe.fog,Oe.lights,{emissive:{value:new pt(0)}}]),vertexShader:yt.meshtoon_vert,fragmentShader:yt.meshtoon_frag},matcap:{uniforms:zn([Oe.common,Oe.bumpmap,Oe.normalmap,Oe.displacementmap,Oe.fog,{matcap:{value:null}}]),vertexShader:yt.meshmatcap_vert,fragmentShader:yt.meshmatcap_frag},points:{uniforms:zn([Oe.points,Oe.fog]),vertexShader:yt.points_vert,fragmentShader:yt.points_frag},dashed:{uniforms:zn([Oe.common,Oe.fog,{scale:{value:1},dashSize:{value:1},totalSize:{value:2}}]),vertexShader:yt.linedashed_vert,fragmentShader:yt.linedashed_frag},depth:{uniforms:zn([Oe.common,Oe.displacementmap]),vertexShader:yt.depth_vert,fragmentShader:yt.depth_frag},normal:{uniforms:zn([Oe.common,Oe.bumpmap,Oe.normalmap,Oe.displacementmap,{opacity:{value:1}}]),vertexShader:yt.meshnormal_vert,fragmentShader:yt.meshnormal_frag},sprite:{uniforms:zn([Oe.sprite,Oe.fog]),vertexShader:yt.sprite_vert,fragmentShader:yt.sprite_frag},background:{uniforms:{uvTransform:{value:new ft},t2D:{value:null},backgroundIntensity:{value:1}},vertexShader:yt.background_vert,fragmentShader:yt.background_frag},backgroundCube:{uniforms:{envMap:{value:null},backgroundBlurriness:{value:0},backgroundIntensity:{value:1},backgroundRotation:{value:new ft}},vertexShader:yt.backgroundCube_vert,fragmentShader:yt.backgroundCube_frag},cube:{uniforms:{tCube:{value:null},tFlip:{value:-1},opacity:{value:1}},vertexShader:yt.cube_vert,fragmentShader:yt.cube_frag},equirect:{uniforms:{tEquirect:{value:null}},vertexShader:yt.equirect_vert,fragmentShader:yt.equirect_frag},distance:{uniforms:zn([Oe.common,Oe.displacementmap,{referencePosition:{value:new X},nearDistance:{value:1},farDistance:{value:1e3}}]),vertexShader:yt.distance_vert,fragmentShader:yt.distance_frag},shadow:{uniforms:zn([Oe.lights,Oe.fog,{color:{value:new pt(0)},opacity:{value:1}}]),vertexShader:yt.shadow_vert,fragmentShader:yt.shadow_frag}};ji.physical={uniforms:zn([ji.standard.uniforms,{clearcoat:{value:0},clearcoatMap:{value:null},clearcoatMapTransform:{value:new ft},clearcoatNormalMap:{value:null},clearcoatNormalMapTransform:{value:new ft},clearcoatNormalScale:{value:new De(1,1)},clearcoatRoughness:{value:0},clearcoatRoughnessMap:{value:null},clearcoatRoughnessMapTransform:{value:new ft},diffuseRoughness:{value:0},diffuseRoughnessMap:{value:null},diffuseRoughnessMapTransform:{value:new ft},dispersion:{value:0},retroreflectivity:{value:0},iridescence:{value:0},iridescenceMap:{value:null},iridescenceMapTransform:{value:new ft},iridescenceIOR:{value:1.3},iridescenceThicknessMinimum:{value:100},iridescenceThicknessMaximum:{value:400},iridescenceThicknessMap:{value:null},iridescenceThicknessMapTransform:{value:new ft},sheen:{value:0},sheenColor:{value:new pt(0)},sheenColorMap:{value:null},sheenColorMapTransform:{value:new ft},sheenRoughness:{value:1},sheenRoughnessMap:{value:null},sheenRoughnessMapTransform:{value:new ft},transmission:{value:0},transmissionMap:{value:null},transmissionMapTransform:{value:new ft},transmissionSamplerSize:{value:new De},transmissionSamplerMap:{value:null},thickness:{value:0},thicknessMap:{value:null},thicknessMapTransform:{value:new ft},attenuationDistance:{value:0},attenuationColor:{value:new pt(0)},specularColor:{value:new pt(1,1,1)},specularColorMap:{value:null},specularColorMapTransform:{value:new ft},specularIntensity:{value:1},specularIntensityMap:{value:null},specularIntensityMapTransform:{value:new ft},anisotropyVector:{value:new De},anisotropyMap:{value:null},anisotropyMapTransform:{value:new ft}}]),vertexShader:yt.meshphysical_vert,fragmentShader:yt.meshphysical_frag};var gh={r:0,b:0,g:0},US=new Ft,xg=new ft;xg.set(-1,0,0,0,1,0,0,0,1);function FS(i,e,t,n,s,r){let o=new pt(0),a=s===!0?0:1,l,c,h=null,d=0,u=null;function f(S){let T=S.isScene===!0?S.background:null;if(T&&T.isTexture){let y=S.backgroundBlurriness>0;T=e.get(T,y)}return T}function p(S){let T=!1,y=f(S);y===null?m(o,a):y&&y.isColor&&(m(y,1),T=!0);let C=i.xr.getEnvironmentBlendMode();C==="additive"?t.buffers.color.setClear(0,0,0,1,r):C==="alpha-blend"&&t.buffers.color.setClear(0,0,0,0,r),(i.autoClear||T)&&(t.buffers.depth.setTest(!0),t.buffers.depth.setMask(!0),t.buffers.color.setMask(!0),i.clear(i.autoClearColor,i.autoClearDepth,i.autoClearStencil))}function x(S,T){let y=f(T);y&&y.isCubeTexture?(c===void 0&&(c=new kn(new Os(1,1,1),new Ji({name:"BackgroundCubeMaterial",uniforms:pr(ji.backgroundCube.uniforms),vertexShader:ji.backgroundCube.vertexShader,fragmentShader:ji.backgroundCube.fragmentShader,side:Kn,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),c.geometry.deleteAttribute("normal"),c.geometry.deleteAttribute("uv"),c.onBeforeRender=function(C,A,v){this.matrixWorld.copyPosition(v.matrixWorld)},Object.defineProperty(c.material,"envMap",{get:function(){return this.uniforms.envMap.value}}),n.update(c)),c.material.uniforms.envMap.value=y,c.material.uniforms.backgroundBlurriness.value=T.backgroundBlurriness,c.material.uniforms.backgroundIntensity.value=T.backgroundIntensity,c.material.uniforms.backgroundRotation.value.setFromMatrix4(US.makeRotationFromEuler(T.backgroundRotation)).transpose(),y.isRenderTargetTexture===!1&&c.material.uniforms.backgroundRotation.value.premultiply(xg),c.material.toneMapped=Tt.getTransfer(y.colorSpace)!==Ut,(h!==y||d!==y.version||u!==i.toneMapping)&&(c.material.needsUpdate=!0,h=y,d=y.version,u=i.toneMapping),c.layers.enableAll(),S.unshift(c,c.geometry,c.material,0,0,null)):y&&y.isTexture&&(l===void 0&&(l=new kn(new Ta(2,2),new Ji({name:"BackgroundMaterial",uniforms:pr(ji.background.uniforms),vertexShader:ji.background.vertexShader,fragmentShader:ji.background.fragmentShader,side:Hs,depthTest:!1,depthWrite:!1,fog:!1,allowOverride:!1})),l.geometry.deleteAttribute("normal"),Object.defineProperty(l.material,"map",{get:function(){return this.uniforms.t2D.value}}),n.update(l)),l.material.uniforms.t2D.value=y,l.material.uniforms.backgroundIntensity.value=T.backgroundIntensity,l.material.toneMapped=Tt.getTransfer(y.colorSpace)!==Ut,y.matrixAutoUpdate===!0&&y.updateMatrix(),l.material.uniforms.uvTransform.value.copy(y.matrix),(h!==y||d!==y.version||u!==i.toneMapping)&&(l.material.needsUpdate=!0,h=y,d=y.version,u=i.toneMapping),l.layers.enableAll(),S.unshift(l,l.geometry,l.material,0,0,null))}function m(S,T){S.getRGB(gh,Nd(i)),t.buffers.color.setClear(gh.r,gh.g,gh.b,T,r)}function g(){c!==void 0&&(c.geometry.dispose(),c.material.dispose(),c=void 0),l!==void 0&&(l.geometry.dispose(),l.material.dispose(),l=void 0)}return{getClearColor:function(){return o},setClearColor:function(S,T=1){o.set(S),a=T,m(o,a)},getClearAlpha:function(){return a},setClearAlpha:function(S){a=S,m(o,a)},render:p,addToRenderList:x,dispose:g}}function OS(i,e){let t=i.getParameter(i.MAX_VERTEX_ATTRIBS),n={},s=u(null),r=s,o=!1;function a(I,G,W,L,H){let Y=!1,z=d(I,L,W,G);r!==z&&(r=z,c(r.object)),Y=f(I,L,W,H),Y&&p(I,L,W,H),H!==null&&e.update(H,i.ELEMENT_ARRAY_BUFFER),(Y||o)&&(o=!1,y(I,G,W,L),H!==null&&i.bindBuffer(i.ELEMENT_ARRAY_BUFFER,e.get(H).buffer))}function l(){return i.createVertexArray()}function c(I){return i.bindVertexArray(I)}function h(I){return i.deleteVertexArray(I)}function d(I,G,W,L){let H=L.wireframe===!0,Y=n[G.id];Y===void 0&&(Y={},n[G.id]=Y);let z=I.isInstancedMesh===!0?I.id:0,ce=Y[z];ce===void 0&&(ce={},Y[z]=ce);let J=ce[W.id];J===void 0&&(J={},ce[W.id]=J);let j=J[H];return j===void 0&&(j=u(l()),J[H]=j),j}function u(I){let G=[],W=[],L=[];for(let H=0;H<t;H++)G[H]=0,W[H]=0,L[H]=0;return{geometry:null,program:null,wireframe:!1,newAttributes:G,enabledAttributes:W,attributeDivisors:L,object:I,attributes:{},index:null}}function f(I,G,W,L){let H=r.attributes,Y=G.attributes,z=0,ce=W.getAttributes();for(let J in ce)if(ce[J].location>=0){let te=H[J],fe=Y[J];if(fe===void 0&&(J==="instanceMatrix"&&I.instanceMatrix&&(fe=I.instanceMatrix),J==="instanceColor"&&I.instanceColor&&(fe=I.instanceColor)),te===void 0||te.attribute!==fe||fe&&te.data!==fe.data)return!0;z++}return r.attributesNum!==z||r.index!==L}function p(I,G,W,L){let H={},Y=G.attributes,z=0,ce=W.getAttributes();for(let J in ce)if(ce[J].location>=0){let te=Y[J];te===void 0&&(J==="instanceMatrix"&&I.instanceMatrix&&(te=I.instanceMatrix),J==="instanceColor"&&I.instanceColor&&(te=I.instanceColor));let fe={};fe.attribute=te,te&&te.data&&(fe.data=te.data),H[J]=fe,z++}r.attributes=H,r.attributesNum=z,r.index=L}function x(){let I=r.newAttributes;for(let G=0,W=I.length;G<W;G++)I[G]=0}function m(I){g(I,0)}function g(I,G){let W=r.newAttributes,L=r.enabledAttributes,H=r.attributeDivisors;W[I]=1,L[I]===0&&(i.enableVertexAttribArray(I),L[I]=1),H[I]!==G&&(i.vertexAttribDivisor(I,G),H[I]=G)}function S(){let I=r.newAttributes,G=r.enabledAttributes;for(let W=0,L=G.length;W<L;W++)G[W]!==I[W]&&(i.disableVertexAttribArray(W),G[W]=0)}function T(I,G,W,L,H,Y,z){z===!0?i.vertexAttribIPointer(I,G,W,H,Y):i.vertexAttribPointer(I,G,W,L,H,Y)}function y(I,G,W,L){x();let H=L.attributes,Y=W.getAttributes(),z=G.defaultAttributeValues;for(let ce in Y){let J=Y[ce];if(J.location>=0){let j=H[ce];if(j===void 0&&(ce==="instanceMatrix"&&I.instanceMatrix&&(j=I.instanceMatrix),ce==="instanceColor"&&I.instanceColor&&(j=I.instanceColor)),j!==void 0){let te=j.normalized,fe=j.itemSize,he=e.get(j);if(he===void 0)continue;let ee=he.buffer,ge=he.type,ve=he.bytesPerElement,Ie=ge===i.INT||ge===i.UNSIGNED_INT||j.gpuType===Lc;if(j.isInterleavedBufferAttribute){let be=j.data,Ge=be.isInterleavedBuffer===!0?be.stride:be.itemSize,st=j.offset;if(be.isInstancedInterleavedBuffer||be.isInstancedBufferAttribute){for(let Je=0;Je<J.locationSize;Je++)g(J.location+Je,be.meshPerAttribute);I.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=be.meshPerAttribute*be.count)}else for(let Je=0;Je<J.locationSize;Je++)m(J.location+Je);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let Je=0;Je<J.locationSize;Je++)T(J.location+Je,fe/J.locationSize,ge,te,Ge*ve,(st+fe/J.locationSize*Je)*ve,Ie)}else{if(j.isInstancedBufferAttribute){for(let be=0;be<J.locationSize;be++)g(J.location+be,j.meshPerAttribute);I.isInstancedMesh!==!0&&L._maxInstanceCount===void 0&&(L._maxInstanceCount=j.meshPerAttribute*j.count)}else for(let be=0;be<J.locationSize;be++)m(J.location+be);i.bindBuffer(i.ARRAY_BUFFER,ee);for(let be=0;be<J.locationSize;be++)T(J.location+be,fe/J.locationSize,ge,te,fe*ve,fe/J.locationSize*be*ve,Ie)}}else if(z!==void 0){let te=z[ce];if(te!==void 0)switch(te.length){case 2:i.vertexAttrib2fv(J.location,te);break;case 3:i.vertexAttrib3fv(J.location,te);break;case 4:i.vertexAttrib4fv(J.location,te);break;default:i.vertexAttrib1fv(J.location,te)}}}}S()}function C(){k();for(let I in n){let G=n[I];for(let W in G){let L=G[W];for(let H in L){let Y=L[H];for(let z in Y)h(Y[z].object),delete Y[z];delete L[H]}}delete n[I]}}function A(I){if(n[I.id]===void 0)return;let G=n[I.id];for(let W in G){let L=G[W];for(let H in L){let Y=L[H];for(let z in Y)h(Y[z].object),delete Y[z];delete L[H]}}delete n[I.id]}function v(I){for(let G in n){let W=n[G];for(let L in W){let H=W[L];if(H[I.id]===void 0)continue;let Y=H[I.id];for(let z in Y)h(Y[z].object),delete Y[z];delete H[I.id]}}}function E(I){for(let G in n){let W=n[G],L=I.isInstancedMesh===!0?I.id:0,H=W[L];if(H!==void 0){for(let Y in H){let z=H[Y];for(let ce in z)h(z[ce].object),delete z[ce];delete H[Y]}delete W[L],Object.keys(W).length===0&&delete n[G]}}}function k(){N(),o=!0,r!==s&&(r=s,c(r.object))}function N(){s.geometry=null,s.program=null,s.wireframe=!1}return{setup:a,reset:k,resetDefaultState:N,dispose:C,releaseStatesOfGeometry:A,releaseStatesOfObject:E,releaseStatesOfProgram:v,initAttributes:x,enableAttribute:m,disableUnusedAttributes:S}}function BS(i,e,t){let n;function s(l){n=l}function r(l,c){i.drawArrays(n,l,c),t.update(c,n,1)}function o(l,c,h){h!==0&&(i.drawArraysInstanced(n,l,c,h),t.update(c,n,h))}function a(l,c,h){if(h===0)return;e.get("WEBGL_multi_draw").multiDrawArraysWEBGL(n,l,0,c,0,h);let u=0;for(let f=0;f<h;f++)u+=c[f];t.update(u,n,1)}this.setMode=s,this.render=r,this.renderInstances=o,this.renderMultiDraw=a}function kS(i,e,t,n){let s;function r(){if(s!==void 0)return s;if(e.has("EXT_texture_filter_anisotropic")===!0){let v=e.get("EXT_texture_filter_anisotropic");s=i.getParameter(v.MAX_TEXTURE_MAX_ANISOTROPY_EXT)}else s=0;return s}function o(v){return!(v!==Li&&n.convert(v)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_FORMAT))}function a(v){let E=v===Ii&&(e.has("EXT_color_buffer_half_float")||e.has("EXT_color_buffer_float"));return!(v!==jn&&v!==Pi&&!E&&n.convert(v)!==i.getParameter(i.IMPLEMENTATION_COLOR_READ_TYPE))}function l(v){if(v==="highp"){if(i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.HIGH_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.HIGH_FLOAT).precision>0)return"highp";v="mediump"}return v==="mediump"&&i.getShaderPrecisionFormat(i.VERTEX_SHADER,i.MEDIUM_FLOAT).precision>0&&i.getShaderPrecisionFormat(i.FRAGMENT_SHADER,i.MEDIUM_FLOAT).precision>0?"mediump":"lowp"}let c=t.precision!==void 0?t.precision:"highp",h=l(c);h!==c&&(tt("WebGLRenderer:",c,"not supported, using",h,"instead."),c=h);let d=t.reversedDepthBuffer===!0&&e.has("EXT_clip_control"),u=t.logarithmicDepthBuffer===!0&&d===!1;t.reversedDepthBuffer===!0&&d===!1&&tt("WebGLRenderer: Unable to use reversed depth buffer due to missing EXT_clip_control extension. Fallback to default depth buffer."),t.logarithmicDepthBuffer===!0&&d===!0&&tt("WebGLRenderer: Logarithmic depth buffer is ignored when reversed depth buffer is enabled.");let f=i.getParameter(i.MAX_TEXTURE_IMAGE_UNITS),p=i.getParameter(i.MAX_VERTEX_TEXTURE_IMAGE_UNITS),x=i.getParameter(i.MAX_TEXTURE_SIZE),m=i.getParameter(i.MAX_CUBE_MAP_TEXTURE_SIZE),g=i.getParameter(i.MAX_VERTEX_ATTRIBS),S=i.getParameter(i.MAX_VERTEX_UNIFORM_VECTORS),T=i.getParameter(i.MAX_VARYING_VECTORS),y=i.getParameter(i.MAX_FRAGMENT_UNIFORM_VECTORS),C=i.getParameter(i.MAX_SAMPLES),A=i.getParameter(i.SAMPLES);return{isWebGL2:!0,getMaxAnisotropy:r,getMaxPrecision:l,textureFormatReadable:o,textureTypeReadable:a,precision:c,logarithmicDepthBuffer:u,reversedDepthBuffer:d,maxTextures:f,maxVertexTextures:p,maxTextureSize:x,maxCubemapSize:m,maxAttributes:g,maxVertexUniforms:S,maxVaryings:T,maxFragmentUniforms:y,maxSamples:C,samples:A}}function zS(i){let e=this,t=null,n=0,s=!1,r=!1,o=new Ti,a=new ft,l={value:null,needsUpdate:!1};this.uniform=l,this.numPlanes=0,this.numIntersection=0,this.init=function(d,u){let f=d.length!==0||u||n!==0||s;return s=u,n=d.length,f},this.beginShadows=function(){r=!0,h(null)},this.endShadows=function(){r=!1},this.setGlobalState=function(d,u){t=h(d,u,0)},this.setState=function(d,u,f){let p=d.clippingPlanes,x=d.clipIntersection,m=d.clipShadows,g=i.get(d);if(!s||p===null||p.length===0||r&&!m)r?h(null):c();else{let S=r?0:n,T=S*4,y=g.clippingState||null;l.value=y,y=h(p,u,T,f);for(let C=0;C!==T;++C)y[C]=t[C];g.clippingState=y,this.numIntersection=x?this.numPlanes:0,this.numPlanes+=S}};function c(){l.value!==t&&(l.value=t,l.needsUpdate=n>0),e.numPlanes=n,e.numIntersection=0}function h(d,u,f,p){let x=d!==null?d.length:0,m=null;if(x!==0){if(m=l.value,p!==!0||m===null){let g=f+x*4,S=u.matrixWorldInverse;a.getNormalMatrix(S),(m===null||m.length<g)&&(m=new Float32Array(g));for(let T=0,y=f;T!==x;++T,y+=4)o.copy(d[T]).applyMatrix4(S,a),o.normal.toArray(m,y),m[y+3]=o.constant}l.value=m,l.needsUpdate=!0}return e.numPlanes=x,e.numIntersection=0,m}}var Va=class extends oi{constructor(e=1,t={}){super(e,e,t),this.isWebGLCubeRenderTarget=!0;let n={width:e,height:e,depth:1},s=[n,n,n,n,n,n];this.texture=new pa(s),this._setTextureOptions(t),this.texture.isRenderTargetTexture=!0}fromEquirectangularTexture(e,t){this.texture.type=t.type,this.texture.colorSpace=t.colorSpace,this.texture.generateMipmaps=t.generateMipmaps,this.texture.minFilter=t.minFilter,this.texture.magFilter=t.magFilter;let n={uniforms:{tEquirect:{value:null}},vertexShader:`

				varying vec3 vWorldDirection;

				vec3 transformDirection( in vec3 dir, in mat4 matrix ) {

					return normalize( ( matrix * vec4( dir, 0.0 ) ).xyz );

				}

				void main() {

					vWorldDirection = transformDirection( position, modelMatrix );

					#include <begin_vertex>
					#include <project_vertex>

				}
			`,fragmentShader:`

				uniform sampler2D tEquirect;

				varying vec3 vWorldDirection;

				#include <common>

				void main() {

					vec3 direction = normalize( vWorldDirection );

					vec2 sampleUV = equirectUv( direction );

					gl_FragColor = texture2D( tEquirect, sampleUV );

				}
			`},s=new Os(5,5,5),r=new Ji({name:"CubemapFromEquirect",uniforms:pr(n.uniforms),vertexShader:n.vertexShader,fragmentShader:n.fragmentShader,side:Kn,blending:hr});r.uniforms.tEquirect.value=t;let o=new kn(s,r),a=t.minFilter;return t.minFilter===_s&&(t.minFilter=Zn),new po(1,10,this).update(e,o),t.minFilter=a,o.geometry.dispose(),o.material.dispose(),this}clear(e,t=!0,n=!0,s=!0){let r=e.getRenderTarget();for(let o=0;o<6;o++)e.setRenderTarget(this,o),e.clear(t,n,s);e.setRenderTarget(r)}},Km=256,HS=3,GS=20,yg=256,Sg=16,VS=3,WS=new X,XS=new pt,vh=class i{constructor(e){this._renderer=e,this._cubeSize=0,this._sourceTarget=null,this._cubeCamera=new po(1,10,null),this._boxMesh=new kn(new Os(5,5,5),null),this._cubemapMaterial=null,this._equirectMaterial=null,this._blurMaterial=null,this._ggxMaterial=null,this._integrationMaterial=null}fromScene(e,t=0,n=.1,s=100,r={}){let{size:o=256,position:a=WS}=r,l=this._renderer;this._setSize(o);let c=this._allocateTarget(),h=this._getSourceTarget(!0);t>0&&(h.texture.mipmapsAutoUpdate=!1);let d=l.autoClear,u=l.autoClearColor,f=l.autoClearDepth,p=l.autoClearStencil,x=e.background;l.autoClear=!0,l.autoClearColor=!0,l.autoClearDepth=!0,l.autoClearStencil=!0,x===null&&(e.background=l.getClearColor(XS));let m=new po(n,s,h);return m.position.copy(a),m.update(l,e),l.autoClear=d,l.autoClearColor=u,l.autoClearDepth=f,l.autoClearStencil=p,e.background=x,t>0&&(h.texture.mipmapsAutoUpdate=!0,this._blur(c,t)),this._applyPMREM(c),c}fromEquirectangular(e,t=null){return this._fromTexture(e,t)}fromCubemap(e,t=null){return this._fromTexture(e,t)}compileCubemapShader(){this._cubemapMaterial===null&&(this._cubemapMaterial=eg(),this._compileMaterial(this._cubemapMaterial))}compileEquirectangularShader(){this._equirectMaterial===null&&(this._equirectMaterial=jm(),this._compileMaterial(this._equirectMaterial))}dispose(){this._sourceTarget!==null&&this._sourceTarget.dispose(),this._cubemapMaterial!==null&&this._cubemapMaterial.dispose(),this._equirectMaterial!==null&&this._equirectMaterial.dispose(),this._blurMaterial!==null&&this._blurMaterial.dispose(),this._ggxMaterial!==null&&this._ggxMaterial.dispose(),this._integrationMaterial!==null&&this._integrationMaterial.dispose(),this._boxMesh.geometry.dispose()}static lodToRoughness(e,t){return t>0?1-Math.sqrt(1-e/t):0}_setSize(e){this._cubeSize=Math.max(Km,km(e))}_fromTexture(e,t){e.mapping===dr||e.mapping===_o?this._setSize(e.image.length===0?Km:e.image[0].width||e.image[0].image.width):this._setSize(e.image.width/4);let n=t||this._allocateTarget();return this._textureToCubemap(e),this._applyPMREM(n),n}_allocateTarget(){let e=this._cubeSize,t=Qm(e,!1,!1),n=Math.log2(e)-HS;for(let s=0;s<=n;s++)t.texture.mipmaps.push({width:e>>s,height:e>>s});return t.texture.name="PMREM",t.texture.isPMREMTexture=!0,t}_getSourceTarget(e=!1){let t=this._cubeSize,n=this._sourceTarget;return(n===null||n.width!==t||e&&n.depthBuffer===!1)&&(n!==null&&n.dispose(),this._sourceTarget=Qm(t,!0,e)),this._sourceTarget}_compileMaterial(e){this._boxMesh.material=e,this._renderer.compile(this._boxMesh,this._cubeCamera.children[0])}_renderCube(e,t,n){let s=this._boxMesh,r=this._cubeCamera;s.material=n,r.renderTarget=e,r.activeMipmapLevel=t;let o=e.width>>t;e.viewport.set(0,0,o,o),r.update(this._renderer,s),e.viewport.set(0,0,e.width,e.height)}_textureToCubemap(e){let t;e.mapping===dr||e.mapping===_o?(this._cubemapMaterial===null&&(this._cubemapMaterial=eg()),t=this._cubemapMaterial,t.uniforms.flipEnvMap.value=e.isRenderTargetTexture===!1?-1:1):(this._equirectMaterial===null&&(this._equirectMaterial=jm()),t=this._equirectMaterial),t.uniforms.envMap.value=e,this._renderCube(this._getSourceTarget(),0,t)}_applyPMREM(e){this._ggxMaterial===null&&(this._ggxMaterial=qS(),this._integrationMaterial=YS());let t=this._cubeSize,n=e.texture.mipmaps.length-1,s=this._ggxMaterial.uniforms;s.envMap.value=this._sourceTarget.texture;let r=this._integrationMaterial.uniforms;r.envMap.value=this._sourceTarget.texture,r.sourceLod.value=Math.log2(t/Sg);for(let o=0;o<=n;o++){let a=i.lodToRoughness(o,n);if(o>n-VS)r.roughness.value=a,this._renderCube(e,o,this._integrationMaterial);else{let l=a>0?Math.log2(t)+.5*Math.log2(6/(yg*Math.pow(a,4)))+.5:0;s.roughness.value=a,s.lodBias.value=l,this._renderCube(e,o,this._ggxMaterial)}}}_blur(e,t){this._blurMaterial===null&&(this._blurMaterial=$S());let n=this._blurMaterial,s=n.uniforms,r=this._sourceTarget;s.sigma.value=Math.min(t,Math.PI)/Math.SQRT2,s.envMap.value=r.texture,this._renderCube(e,0,n),s.envMap.value=e.texture,this._renderCube(r,0,n)}};function Qm(i,e,t){return new Va(i,{minFilter:_s,generateMipmaps:e,type:Ii,colorSpace:ia,depthBuffer:t})}function Wa(i,e,t){return new Ji({name:i,uniforms:e,vertexShader:yt.cube_vert,fragmentShader:t,side:Kn,blending:hr,depthTest:!1,depthWrite:!1})}function qS(){return Wa("PMREMGGXConvolution",{envMap:{value:null},roughness:{value:0},lodBias:{value:0}},`

		#define GGX_SAMPLES ${yg}u

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float lodBias;

		#include <common>

		// Van der Corput radical inverse
		float radicalInverse_VdC( uint bits ) {

			bits = ( bits << 16u ) | ( bits >> 16u );
			bits = ( ( bits & 0x55555555u ) << 1u ) | ( ( bits & 0xAAAAAAAAu ) >> 1u );
			bits = ( ( bits & 0x33333333u ) << 2u ) | ( ( bits & 0xCCCCCCCCu ) >> 2u );
			bits = ( ( bits & 0x0F0F0F0Fu ) << 4u ) | ( ( bits & 0xF0F0F0F0u ) >> 4u );
			bits = ( ( bits & 0x00FF00FFu ) << 8u ) | ( ( bits & 0xFF00FF00u ) >> 8u );
			return float( bits ) * 2.3283064365386963e-10; // / 0x100000000

		}

		// Hammersley sequence
		vec2 hammersley( uint i, uint N ) {

			return vec2( float( i ) / float( N ), radicalInverse_VdC( i ) );

		}

		void main() {

			vec3 N = normalize( vWorldDirection );

			// For very low roughness, just sample the environment directly
			if ( roughness < 0.001 ) {

				gl_FragColor = vec4( textureLod( envMap, N, 0.0 ).rgb, 1.0 );
				return;

			}

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			// Tangent space basis for VNDF sampling
			vec3 up = abs( N.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, N ) );
			vec3 bitangent = cross( N, tangent );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			for ( uint i = 0u; i < GGX_SAMPLES; i ++ ) {

				vec2 Xi = hammersley( i, GGX_SAMPLES );

				// With V = N, sample the reflected direction directly.
				float invQ = 1.0 / ( 1.0 - Xi.x + alpha2 * Xi.x );
				float NdotL = ( 1.0 - Xi.x - alpha2 * Xi.x ) * invQ;

				if ( NdotL > 0.0 ) {

					float phi = 2.0 * PI * Xi.y;
					float sinTheta = 2.0 * alpha * sqrt( Xi.x * ( 1.0 - Xi.x ) ) * invQ;
					vec3 L = N * NdotL + ( tangent * cos( phi ) + bitangent * sin( phi ) ) * sinTheta;

					// Match the source mip to the sample's solid angle. The terms
					// independent of the sample are precomputed in lodBias.
					float d = alpha2 * invQ;
					float lod = max( log2( d ) + lodBias, 0.0 );

					// Weight by NdotL for the split-sum approximation
					prefilteredColor += textureLod( envMap, L, lod ).rgb * NdotL;
					totalWeight += NdotL;

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function YS(){return Wa("PMREMGGXIntegration",{envMap:{value:null},roughness:{value:0},sourceLod:{value:0},sourceSize:{value:Sg}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float roughness;
		uniform float sourceLod;
		uniform int sourceSize;

		void main() {

			vec3 N = normalize( vWorldDirection );

			float alpha = roughness * roughness;
			float alpha2 = alpha * alpha;

			float texelSize = 2.0 / float( sourceSize );

			vec3 prefilteredColor = vec3( 0.0 );
			float totalWeight = 0.0;

			// Pair opposite texels: only the one in N's hemisphere contributes.
			for ( int face = 0; face < 3; face ++ ) {

				for ( int y = 0; y < sourceSize; y ++ ) {

					for ( int x = 0; x < sourceSize; x ++ ) {

						vec2 uv = ( vec2( x, y ) + 0.5 ) * texelSize - 1.0;
						vec3 texelDirection = face == 0 ? vec3( 1.0, uv ) : ( face == 1 ? vec3( uv.x, 1.0, uv.y ) : vec3( uv, 1.0 ) );

						float invDistance = inversesqrt( 1.0 + dot( uv, uv ) );
						float NdotL = dot( N, texelDirection );
						texelDirection *= NdotL < 0.0 ? - 1.0 : 1.0;
						NdotL = abs( NdotL ) * invDistance;

						// With V = N, NdotH squared is ( 1 + NdotL ) / 2. Common factors
						// in the GGX distribution and texel solid angle cancel when normalized.
						float d = 1.0 + alpha2 + ( alpha2 - 1.0 ) * NdotL;
						float weight = NdotL * invDistance * invDistance * invDistance / ( d * d );

						prefilteredColor += textureLod( envMap, texelDirection, sourceLod ).rgb * weight;
						totalWeight += weight;

					}

				}

			}

			gl_FragColor = vec4( prefilteredColor / totalWeight, 1.0 );

		}
	`)}function $S(){return Wa("PMREMSphericalGaussianBlur",{envMap:{value:null},sigma:{value:0}},`

		#define SAMPLES ${GS}
		#define GOLDEN_ANGLE 2.39996322973

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float sigma;

		#include <common>

		void main() {

			vec3 outputDirection = normalize( vWorldDirection );

			vec3 up = abs( outputDirection.z ) < 0.999 ? vec3( 0.0, 0.0, 1.0 ) : vec3( 1.0, 0.0, 0.0 );
			vec3 tangent = normalize( cross( up, outputDirection ) );
			vec3 bitangent = cross( outputDirection, tangent );

			// Truncate the kernel at three standard deviations or at the antipode.
			float thetaMax = min( 3.0 * sigma, PI );
			float truncation = 1.0 - exp( - 0.5 * thetaMax * thetaMax / ( sigma * sigma ) );

			vec3 accumColor = vec3( 0.0 );
			float accumWeight = 0.0;

			for ( int i = 0; i < SAMPLES; i ++ ) {

				// Stratified inverse-CDF sampling of the Gaussian, placed on a golden-angle spiral.
				float stratum = ( float( i ) + 0.5 ) / float( SAMPLES );
				float theta = sigma * sqrt( - 2.0 * log( 1.0 - stratum * truncation ) );
				float phi = float( i ) * GOLDEN_ANGLE;

				vec3 offset = cos( phi ) * tangent + sin( phi ) * bitangent;
				vec3 sampleDirection = cos( theta ) * outputDirection + sin( theta ) * offset;

				// Correct the planar sample density to solid angle.
				float weight = sin( theta ) / theta;

				accumColor += weight * textureLod( envMap, sampleDirection, 0.0 ).rgb;
				accumWeight += weight;

			}

			gl_FragColor = vec4( accumColor / accumWeight, 1.0 );

		}
	`)}function jm(){return Wa("PMREMEquirectangularToCubemap",{envMap:{value:null}},`

		varying vec3 vWorldDirection;

		uniform sampler2D envMap;

		#include <common>

		void main() {

			// Average four subpixel samples to preserve small, bright features.
			vec3 direction = normalize( vWorldDirection );
			vec3 dx = dFdx( direction ) * 0.25;
			vec3 dy = dFdy( direction ) * 0.25;

			vec3 color = textureLod( envMap, equirectUv( normalize( direction - dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx - dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction - dx + dy ) ), 0.0 ).rgb;
			color += textureLod( envMap, equirectUv( normalize( direction + dx + dy ) ), 0.0 ).rgb;
			gl_FragColor = vec4( color * 0.25, 1.0 );

		}
	`)}function eg(){return Wa("PMREMCubemapToCubemap",{envMap:{value:null},flipEnvMap:{value:-1}},`

		varying vec3 vWorldDirection;

		uniform samplerCube envMap;
		uniform float flipEnvMap;

		void main() {

			gl_FragColor = vec4( textureCube( envMap, vec3( flipEnvMap * vWorldDirection.x, vWorldDirection.yz ) ).rgb, 1.0 );

		}
	`)}function ZS(i){let e=new WeakMap,t=new WeakMap,n=null;function s(u,f=!1){return u==null?null:f?o(u):r(u)}function r(u){if(u&&u.isTexture){let f=u.mapping;if(f===Cc||f===Pc)if(e.has(u)){let p=e.get(u).texture;return a(p,u.mapping)}else{let p=u.image;if(p&&p.height>0){let x=new Va(p.height);return x.fromEquirectangularTexture(i,u),e.set(u,x),u.addEventListener("dispose",c),a(x.texture,u.mapping)}else return null}}return u}function o(u){if(u&&u.isTexture&&u.isPMREMTexture!==!0){let f=u.mapping,p=f===Cc||f===Pc,x=f===dr||f===_o;if(p||x){let m=t.get(u),g=m!==void 0?m.texture.pmremVersion:0;if(u.isRenderTargetTexture&&u.pmremVersion!==g)return n===null&&(n=new vh(i)),m=p?n.fromEquirectangular(u,m):n.fromCubemap(u,m),m.texture.pmremVersion=u.pmremVersion,t.set(u,m),m.texture;if(m!==void 0)return m.texture;{let S=u.image;return p&&S&&S.height>0||x&&S&&l(S)?(n===null&&(n=new vh(i)),m=p?n.fromEquirectangular(u):n.fromCubemap(u),m.texture.pmremVersion=u.pmremVersion,t.set(u,m),u.addEventListener("dispose",h),m.texture):null}}}return u}function a(u,f){return f===Cc?u.mapping=dr:f===Pc&&(u.mapping=_o),u}function l(u){let f=0,p=6;for(let x=0;x<p;x++)u[x]!==void 0&&f++;return f===p}function c(u){let f=u.target;f.removeEventListener("dispose",c);let p=e.get(f);p!==void 0&&(e.delete(f),p.dispose())}function h(u){let f=u.target;f.removeEventListener("dispose",h);let p=t.get(f);p!==void 0&&(t.delete(f),p.dispose())}function d(){e=new WeakMap,t=new WeakMap,n!==null&&(n.dispose(),n=null)}return{get:s,dispose:d}}function JS(i){let e={};function t(n){if(e[n]!==void 0)return e[n];let s=i.getExtension(n);return e[n]=s,s}return{has:function(n){return t(n)!==null},init:function(){t("EXT_color_buffer_float"),t("WEBGL_clip_cull_distance"),t("OES_texture_float_linear"),t("EXT_color_buffer_half_float"),t("WEBGL_multisampled_render_to_texture"),t("WEBGL_render_shared_exponent")},get:function(n){let s=t(n);return s===null&&jo("WebGLRenderer: "+n+" extension not supported."),s}}}function KS(i,e,t,n){let s={},r=new WeakMap,o=new FinalizationRegistry(p=>delete s[p]);function a(p){l(p.target)}function l(p){p.index!==null&&e.remove(p.index);for(let m in p.attributes)e.remove(p.attributes[m]);p.removeEventListener("dispose",a),delete s[p.id],o.unregister(p);let x=r.get(p);x&&(e.remove(x),r.delete(p)),n.releaseStatesOfGeometry(p),p.isInstancedBufferGeometry===!0&&delete p._maxInstanceCount,t.memory.geometries--}function c(p,x){return s[x.id]!==void 0||(x.addEventListener("dispose",a),s[x.id]=new WeakRef(x),o.register(x,x.id,x),t.memory.geometries++),x}function h(p){let x=p.attributes;for(let m in x)e.update(x[m],i.ARRAY_BUFFER)}function d(p){let x=p.index,m=p.attributes.position,g=0;if(m===void 0)return;let S=x!==null?x.array.length:m.array.length/3-1,T=m.count>=65535?ha:ca,y=new T(Math.ceil(S/3)*6,1),C=y.array;if(x!==null){let v=x.array;g=x.version;for(let E=0,k=0;E<S;E+=3){let N=v[E+0],I=v[E+1],G=v[E+2];C[k++]=N,C[k++]=I,C[k++]=I,C[k++]=G,C[k++]=G,C[k++]=N}}else{g=m.version;for(let v=0,E=0;v<S;v+=3){let k=v+0,N=v+1,I=v+2;C[E++]=k,C[E++]=N,C[E++]=N,C[E++]=I,C[E++]=I,C[E++]=k}}y.version=g;let A=r.get(p);A&&e.remove(A),r.set(p,y)}function u(p){let x=r.get(p);if(x){let m=p.index;m!==null&&x.version<m.version&&d(p)}else d(p);return r.get(p)}function f(){for(let p in s){let x=s[p].deref();x!==void 0&&l(x)}}return{get:c,update:h,getWireframeAttribute:u,dispose:f}}function QS(i,e,t){let n;function s(d){n=d}let r,o;function a(d){r=d.type,o=d.bytesPerElement}function l(d,u){i.drawElements(n,u,r,d*o),t.update(u,n,1)}function c(d,u,f){f!==0&&(i.drawElementsInstanced(n,u,r,d*o,f),t.update(u,n,f))}function h(d,u,f){if(f===0)return;e.get("WEBGL_multi_draw").multiDrawElementsWEBGL(n,u,0,r,d,0,f);let x=0;for(let m=0;m<f;m++)x+=u[m];t.update(x,n,1)}this.setMode=s,this.setIndex=a,this.render=l,this.renderInstances=c,this.renderMultiDraw=h}function jS(i){let e={geometries:0,textures:0},t={frame:0,calls:0,triangles:0,points:0,lines:0};function n(r,o,a){switch(t.calls++,o){case i.TRIANGLES:t.triangles+=a*(r/3);break;case i.LINES:t.lines+=a*(r/2);break;case i.LINE_STRIP:t.lines+=a*(r-1);break;case i.LINE_LOOP:t.lines+=a*r;break;case i.POINTS:t.points+=a*r;break;default:at("WebGLInfo: Unknown draw mode:",o);break}}function s(){t.calls=0,t.triangles=0,t.points=0,t.lines=0}return{memory:e,render:t,programs:null,autoReset:!0,reset:s,update:n}}function eM(i,e,t){let n=new WeakMap,s=new tn;function r(o,a,l){let c=o.morphTargetInfluences,h=a.morphAttributes.position||a.morphAttributes.normal||a.morphAttributes.color,d=h!==void 0?h.length:0,u=n.get(a);if(u===void 0||u.count!==d){let k=function(){v.dispose(),n.delete(a),a.removeEventListener("dispose",k)};u!==void 0&&u.texture.dispose();let f=a.morphAttributes.position!==void 0,p=a.morphAttributes.normal!==void 0,x=a.morphAttributes.color!==void 0,m=a.morphAttributes.position||[],g=a.morphAttributes.normal||[],S=a.morphAttributes.color||[],T=0;f===!0&&(T=1),p===!0&&(T=2),x===!0&&(T=3);let y=a.attributes.position.count*T,C=1;y>e.maxTextureSize&&(C=Math.ceil(y/e.maxTextureSize),y=e.maxTextureSize);let A=new Float32Array(y*C*4*d),v=new aa(A,y,C,d);v.type=Pi,v.needsUpdate=!0;let E=T*4;for(let N=0;N<d;N++){let I=m[N],G=g[N],W=S[N],L=y*C*4*N;for(let H=0;H<I.count;H++){let Y=H*E;f===!0&&(s.fromBufferAttribute(I,H),A[L+Y+0]=s.x,A[L+Y+1]=s.y,A[L+Y+2]=s.z,A[L+Y+3]=0),p===!0&&(s.fromBufferAttribute(G,H),A[L+Y+4]=s.x,A[L+Y+5]=s.y,A[L+Y+6]=s.z,A[L+Y+7]=0),x===!0&&(s.fromBufferAttribute(W,H),A[L+Y+8]=s.x,A[L+Y+9]=s.y,A[L+Y+10]=s.z,A[L+Y+11]=W.itemSize===4?s.w:1)}}u={count:d,texture:v,size:new De(y,C)},n.set(a,u),a.addEventListener("dispose",k)}if(o.isInstancedMesh===!0&&o.morphTexture!==null)l.getUniforms().setValue(i,"morphTexture",o.morphTexture,t);else{let f=0;for(let x=0;x<c.length;x++)f+=c[x];let p=a.morphTargetsRelative?1:1-f;l.getUniforms().setValue(i,"morphTargetBaseInfluence",p),l.getUniforms().setValue(i,"morphTargetInfluences",c)}l.getUniforms().setValue(i,"morphTargetsTexture",u.texture,t),l.getUniforms().setValue(i,"morphTargetsTextureSize",u.size)}return{update:r}}function tM(i,e,t,n,s){let r=new WeakMap;function o(c){let h=s.render.frame,d=c.geometry,u=e.get(c,d);if(r.get(u)!==h&&(e.update(u),r.set(u,h)),c.isInstancedMesh&&(c.hasEventListener("dispose",l)===!1&&c.addEventListener("dispose",l),r.get(c)!==h&&(t.update(c.instanceMatrix,i.ARRAY_BUFFER),c.instanceColor!==null&&t.update(c.instanceColor,i.ARRAY_BUFFER),r.set(c,h))),c.isSkinnedMesh){let f=c.skeleton;r.get(f)!==h&&(f.update(),r.set(f,h))}return u}function a(){r=new WeakMap}function l(c){let h=c.target;h.removeEventListener("dispose",l),n.releaseStatesOfObject(h),t.remove(h.instanceMatrix),h.instanceColor!==null&&t.remove(h.instanceColor)}return{update:o,dispose:a}}var nM={[dd]:"LINEAR_TONE_MAPPING",[fd]:"REINHARD_TONE_MAPPING",[pd]:"CINEON_TONE_MAPPING",[md]:"ACES_FILMIC_TONE_MAPPING",[_d]:"AGX_TONE_MAPPING",[vd]:"NEUTRAL_TONE_MAPPING",[gd]:"CUSTOM_TONE_MAPPING"};function iM(i,e,t,n,s,r){let o=new oi(e,t,{type:i,depthBuffer:s,stencilBuffer:r,samples:n?4:0,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,resolveDepthBuffer:!1,resolveStencilBuffer:!1}),a=null,l=null,c=null,h=new Jt;h.setAttribute("position",new Lt([-1,3,0,-1,-1,0,3,-1,0],3)),h.setAttribute("uv",new Lt([0,2,0,0,2,0],2));let d=new dc({uniforms:{tDiffuse:{value:null}},vertexShader:`
			precision highp float;

			uniform mat4 modelViewMatrix;
			uniform mat4 projectionMatrix;

			attribute vec3 position;
			attribute vec2 uv;

			varying vec2 vUv;

			void main() {
				vUv = uv;
				gl_Position = projectionMatrix * modelViewMatrix * vec4( position, 1.0 );
			}`,fragmentShader:`
			precision highp float;

			uniform sampler2D tDiffuse;

			varying vec2 vUv;

			#include <tonemapping_pars_fragment>
			#include <colorspace_pars_fragment>

			void main() {
				gl_FragColor = texture2D( tDiffuse, vUv );

				#ifdef LINEAR_TONE_MAPPING
					gl_FragColor.rgb = LinearToneMapping( gl_FragColor.rgb );
				#elif defined( REINHARD_TONE_MAPPING )
					gl_FragColor.rgb = ReinhardToneMapping( gl_FragColor.rgb );
				#elif defined( CINEON_TONE_MAPPING )
					gl_FragColor.rgb = CineonToneMapping( gl_FragColor.rgb );
				#elif defined( ACES_FILMIC_TONE_MAPPING )
					gl_FragColor.rgb = ACESFilmicToneMapping( gl_FragColor.rgb );
				#elif defined( AGX_TONE_MAPPING )
					gl_FragColor.rgb = AgXToneMapping( gl_FragColor.rgb );
				#elif defined( NEUTRAL_TONE_MAPPING )
					gl_FragColor.rgb = NeutralToneMapping( gl_FragColor.rgb );
				#elif defined( CUSTOM_TONE_MAPPING )
					gl_FragColor.rgb = CustomToneMapping( gl_FragColor.rgb );
				#endif

				#ifdef SRGB_TRANSFER
					gl_FragColor = sRGBTransferOETF( gl_FragColor );
				#endif
			}`,depthTest:!1,depthWrite:!1}),u=new kn(h,d),f=new cr(-1,1,1,-1,0,1),p=null,x=null,m=!1,g,S=null,T=[],y=!1;this.setSize=function(C,A){o.setSize(C,A),a!==null&&a.setSize(C,A),l!==null&&l.setSize(C,A);for(let v=0;v<T.length;v++){let E=T[v];E.setSize&&E.setSize(C,A)}},this.setEffects=function(C){T=C,y=T.length>0&&T[0].isRenderPass===!0;let A=o.width,v=o.height;T.length>0&&a===null&&(a=new oi(A,v,{type:Ii,depthBuffer:!1,stencilBuffer:!1}),l=new oi(A,v,{type:Ii,depthBuffer:!1,stencilBuffer:!1}));let E=s===!0&&T.some(k=>k.needsDepthTexture===!0);E!==(o.depthTexture!==null)&&(E===!0&&c===null&&(c=new gs(A,v),r===!0&&(c.format=vs,c.type=fr)),o.dispose(),o.depthTexture=E?c:null,o.resolveDepthBuffer=E,o.storeMultisampledDepthBuffer=E);for(let k=0;k<T.length;k++){let N=T[k];N.setSize&&N.setSize(A,v),E&&N.needsDepthTexture===!0&&N.setDepthTexture&&N.setDepthTexture(c)}},this.begin=function(C,A){if(m||C.toneMapping===Ki&&T.length===0)return!1;if(S=A,A!==null){let v=A.width,E=A.height;(o.width!==v||o.height!==E)&&this.setSize(v,E)}return y===!1&&C.setRenderTarget(o),g=C.toneMapping,C.toneMapping=Ki,!0},this.hasRenderPass=function(){return y},this.end=function(C,A){C.toneMapping=g,m=!0;let v=o,E=a;for(let k=0;k<T.length;k++){let N=T[k];N.enabled!==!1&&(N.render(C,E,v,A),N.needsSwap!==!1&&(v=E,E=E===a?l:a))}if(p!==C.outputColorSpace||x!==C.toneMapping){p=C.outputColorSpace,x=C.toneMapping,d.defines={},Tt.getTransfer(p)===Ut&&(d.defines.SRGB_TRANSFER="");let k=nM[x];k&&(d.defines[k]=""),d.needsUpdate=!0}d.uniforms.tDiffuse.value=v.texture,C.setRenderTarget(S),C.render(u,f),S=null,m=!1},this.isCompositing=function(){return m},this.dispose=function(){o.dispose(),a!==null&&a.dispose(),l!==null&&l.dispose(),h.dispose(),d.dispose()}}var Mg=new Jn,bg=new gs(1,1),wg=new ga(1),Eg=new aa,Tg=new tc,Ag=new pa,tg=[],ng=[],ig=new Float32Array(16),sg=new Float32Array(9),rg=new Float32Array(4);function yo(i,e,t){let n=i[0];if(n<=0||n>0)return i;let s=e*t,r=tg[s];if(r===void 0&&(r=new Float32Array(s),tg[s]=r),e!==0){n.toArray(r,0);for(let o=1,a=0;o!==e;++o)a+=t,i[o].toArray(r,a)}return r}function vn(i,e){if(i.length!==e.length)return!1;for(let t=0,n=i.length;t<n;t++)if(i[t]!==e[t])return!1;return!0}function xn(i,e){for(let t=0,n=e.length;t<n;t++)i[t]=e[t]}function yh(i,e){let t=ng[e];t===void 0&&(t=new Int32Array(e),ng[e]=t);for(let n=0;n!==e;++n)t[n]=i.allocateTextureUnit();return t}function sM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1f(this.addr,e),t[0]=e)}function rM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2f(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(vn(t,e))return;i.uniform2fv(this.addr,e),xn(t,e)}}function oM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3f(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else if(e.r!==void 0)(t[0]!==e.r||t[1]!==e.g||t[2]!==e.b)&&(i.uniform3f(this.addr,e.r,e.g,e.b),t[0]=e.r,t[1]=e.g,t[2]=e.b);else{if(vn(t,e))return;i.uniform3fv(this.addr,e),xn(t,e)}}function aM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4f(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(vn(t,e))return;i.uniform4fv(this.addr,e),xn(t,e)}}function lM(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(vn(t,e))return;i.uniformMatrix2fv(this.addr,!1,e),xn(t,e)}else{if(vn(t,n))return;rg.set(n),i.uniformMatrix2fv(this.addr,!1,rg),xn(t,n)}}function cM(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(vn(t,e))return;i.uniformMatrix3fv(this.addr,!1,e),xn(t,e)}else{if(vn(t,n))return;sg.set(n),i.uniformMatrix3fv(this.addr,!1,sg),xn(t,n)}}function hM(i,e){let t=this.cache,n=e.elements;if(n===void 0){if(vn(t,e))return;i.uniformMatrix4fv(this.addr,!1,e),xn(t,e)}else{if(vn(t,n))return;ig.set(n),i.uniformMatrix4fv(this.addr,!1,ig),xn(t,n)}}function uM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1i(this.addr,e),t[0]=e)}function dM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2i(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(vn(t,e))return;i.uniform2iv(this.addr,e),xn(t,e)}}function fM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3i(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(vn(t,e))return;i.uniform3iv(this.addr,e),xn(t,e)}}function pM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4i(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(vn(t,e))return;i.uniform4iv(this.addr,e),xn(t,e)}}function mM(i,e){let t=this.cache;t[0]!==e&&(i.uniform1ui(this.addr,e),t[0]=e)}function gM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y)&&(i.uniform2ui(this.addr,e.x,e.y),t[0]=e.x,t[1]=e.y);else{if(vn(t,e))return;i.uniform2uiv(this.addr,e),xn(t,e)}}function _M(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z)&&(i.uniform3ui(this.addr,e.x,e.y,e.z),t[0]=e.x,t[1]=e.y,t[2]=e.z);else{if(vn(t,e))return;i.uniform3uiv(this.addr,e),xn(t,e)}}function vM(i,e){let t=this.cache;if(e.x!==void 0)(t[0]!==e.x||t[1]!==e.y||t[2]!==e.z||t[3]!==e.w)&&(i.uniform4ui(this.addr,e.x,e.y,e.z,e.w),t[0]=e.x,t[1]=e.y,t[2]=e.z,t[3]=e.w);else{if(vn(t,e))return;i.uniform4uiv(this.addr,e),xn(t,e)}}function Sh(i){return i.version===0&&(i.compareFunction=Cd,i.needsUpdate=!0),i}function xM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_2D_SHADOW?r=Sh(bg):r=Mg,t.setTexture2D(e||r,s)}function yM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture3D(e||Tg,s)}function SM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s);let r;this.type===i.SAMPLER_CUBE_SHADOW?r=Sh(wg):r=Ag,t.setTextureCube(e||r,s)}function MM(i,e,t){let n=this.cache,s=t.allocateTextureUnit();n[0]!==s&&(i.uniform1i(this.addr,s),n[0]=s),t.setTexture2DArray(e||Eg,s)}function bM(i){switch(i){case 5126:return sM;case 35664:return rM;case 35665:return oM;case 35666:return aM;case 35674:return lM;case 35675:return cM;case 35676:return hM;case 5124:case 35670:return uM;case 35667:case 35671:return dM;case 35668:case 35672:return fM;case 35669:case 35673:return pM;case 5125:return mM;case 36294:return gM;case 36295:return _M;case 36296:return vM;case 35678:case 36198:case 36298:case 36306:case 35682:return xM;case 35679:case 36299:case 36307:return yM;case 35680:case 36300:case 36308:case 36293:return SM;case 36289:case 36303:case 36311:case 36292:return MM}}function wM(i,e){i.uniform1fv(this.addr,e)}function EM(i,e){let t=yo(e,this.size,2);i.uniform2fv(this.addr,t)}function TM(i,e){let t=yo(e,this.size,3);i.uniform3fv(this.addr,t)}function AM(i,e){let t=yo(e,this.size,4);i.uniform4fv(this.addr,t)}function RM(i,e){let t=yo(e,this.size,4);i.uniformMatrix2fv(this.addr,!1,t)}function CM(i,e){let t=yo(e,this.size,9);i.uniformMatrix3fv(this.addr,!1,t)}function PM(i,e){let t=yo(e,this.size,16);i.uniformMatrix4fv(this.addr,!1,t)}function IM(i,e){i.uniform1iv(this.addr,e)}function LM(i,e){i.uniform2iv(this.addr,e)}function DM(i,e){i.uniform3iv(this.addr,e)}function NM(i,e){i.uniform4iv(this.addr,e)}function UM(i,e){i.uniform1uiv(this.addr,e)}function FM(i,e){i.uniform2uiv(this.addr,e)}function OM(i,e){i.uniform3uiv(this.addr,e)}function BM(i,e){i.uniform4uiv(this.addr,e)}function kM(i,e,t){let n=this.cache,s=e.length,r=yh(t,s);vn(n,r)||(i.uniform1iv(this.addr,r),xn(n,r));let o;this.type===i.SAMPLER_2D_SHADOW?o=Sh(bg):o=Mg;for(let a=0;a!==s;++a)t.setTexture2D(e[a]||o,r[a])}function zM(i,e,t){let n=this.cache,s=e.length,r=yh(t,s);vn(n,r)||(i.uniform1iv(this.addr,r),xn(n,r));for(let o=0;o!==s;++o)t.setTexture3D(e[o]||Tg,r[o])}function HM(i,e,t){let n=this.cache,s=e.length,r=yh(t,s);vn(n,r)||(i.uniform1iv(this.addr,r),xn(n,r));let o;this.type===i.SAMPLER_CUBE_SHADOW?o=Sh(wg):o=Ag;for(let a=0;a!==s;++a)t.setTextureCube(e[a]||o,r[a])}function GM(i,e,t){let n=this.cache,s=e.length,r=yh(t,s);vn(n,r)||(i.uniform1iv(this.addr,r),xn(n,r));for(let o=0;o!==s;++o)t.setTexture2DArray(e[o]||Eg,r[o])}function VM(i){switch(i){case 5126:return wM;case 35664:return EM;case 35665:return TM;case 35666:return AM;case 35674:return RM;case 35675:return CM;case 35676:return PM;case 5124:case 35670:return IM;case 35667:case 35671:return LM;case 35668:case 35672:return DM;case 35669:case 35673:return NM;case 5125:return UM;case 36294:return FM;case 36295:return OM;case 36296:return BM;case 35678:case 36198:case 36298:case 36306:case 35682:return kM;case 35679:case 36299:case 36307:return zM;case 35680:case 36300:case 36308:case 36293:return HM;case 36289:case 36303:case 36311:case 36292:return GM}}var Xd=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.setValue=bM(t.type)}},qd=class{constructor(e,t,n){this.id=e,this.addr=n,this.cache=[],this.type=t.type,this.size=t.size,this.setValue=VM(t.type)}},Yd=class{constructor(e){this.id=e,this.seq=[],this.map={}}setValue(e,t,n){let s=this.seq;for(let r=0,o=s.length;r!==o;++r){let a=s[r];a.setValue(e,t[a.id],n)}}},Vd=/(\w+)(\])?(\[|\.)?/g;function og(i,e){i.seq.push(e),i.map[e.id]=e}function WM(i,e,t){let n=i.name,s=n.length;for(Vd.lastIndex=0;;){let r=Vd.exec(n),o=Vd.lastIndex,a=r[1],l=r[2]==="]",c=r[3];if(l&&(a=a|0),c===void 0||c==="["&&o+2===s){og(t,c===void 0?new Xd(a,i,e):new qd(a,i,e));break}else{let d=t.map[a];d===void 0&&(d=new Yd(a),og(t,d)),t=d}}}var xo=class{constructor(e,t){this.seq=[],this.map={};let n=e.getProgramParameter(t,e.ACTIVE_UNIFORMS);for(let o=0;o<n;++o){let a=e.getActiveUniform(t,o),l=e.getUniformLocation(t,a.name);WM(a,l,this)}let s=[],r=[];for(let o of this.seq)o.type===e.SAMPLER_2D_SHADOW||o.type===e.SAMPLER_CUBE_SHADOW||o.type===e.SAMPLER_2D_ARRAY_SHADOW?s.push(o):r.push(o);s.length>0&&(this.seq=s.concat(r))}setValue(e,t,n,s){let r=this.map[t];r!==void 0&&r.setValue(e,n,s)}setOptional(e,t,n){let s=t[n];s!==void 0&&this.setValue(e,n,s)}static upload(e,t,n,s){for(let r=0,o=t.length;r!==o;++r){let a=t[r],l=n[a.id];l.needsUpdate!==!1&&a.setValue(e,l.value,s)}}static seqWithValue(e,t){let n=[];for(let s=0,r=e.length;s!==r;++s){let o=e[s];o.id in t&&n.push(o)}return n}};function ag(i,e,t){let n=i.createShader(e);return i.shaderSource(n,t),i.compileShader(n),n}var XM=37297,qM=0;function YM(i,e){let t=i.split(`
`),n=[],s=Math.max(e-6,0),r=Math.min(e+6,t.length);for(let o=s;o<r;o++){let a=o+1;n.push(`${a===e?">":" "} ${a}: ${t[o]}`)}return n.join(`
`)}var lg=new ft;function $M(i){Tt._getMatrix(lg,Tt.workingColorSpace,i);let e=`mat3( ${lg.elements.map(t=>t.toFixed(4))} )`;switch(Tt.getTransfer(i)){case sa:return[e,"LinearTransferOETF"];case Ut:return[e,"sRGBTransferOETF"];default:return tt("WebGLProgram: Unsupported color space: ",i),[e,"LinearTransferOETF"]}}function cg(i,e,t){let n=i.getShaderParameter(e,i.COMPILE_STATUS),r=(i.getShaderInfoLog(e)||"").trim();if(n&&r==="")return"";let o=/ERROR: 0:(\d+)/.exec(r);if(o){let a=parseInt(o[1]);return t.toUpperCase()+`

`+r+`

`+YM(i.getShaderSource(e),a)}else return r}function ZM(i,e){let t=$M(e);return[`vec4 ${i}( vec4 value ) {`,`	return ${t[1]}( vec4( ${t[0]} * value.rgb, value.a ) );`,"}"].join(`
`)}var JM={[dd]:"Linear",[fd]:"Reinhard",[pd]:"Cineon",[md]:"ACESFilmic",[_d]:"AgX",[vd]:"Neutral",[gd]:"Custom"};function KM(i,e){let t=JM[e];return t===void 0?(tt("WebGLProgram: Unsupported toneMapping:",e),"vec3 "+i+"( vec3 color ) { return LinearToneMapping( color ); }"):"vec3 "+i+"( vec3 color ) { return "+t+"ToneMapping( color ); }"}var _h=new X;function QM(){Tt.getLuminanceCoefficients(_h);let i=_h.x.toFixed(4),e=_h.y.toFixed(4),t=_h.z.toFixed(4);return["float luminance( const in vec3 rgb ) {",`	const vec3 weights = vec3( ${i}, ${e}, ${t} );`,"	return dot( weights, rgb );","}"].join(`
`)}function jM(i){return[i.extensionClipCullDistance?"#extension GL_ANGLE_clip_cull_distance : require":"",i.extensionMultiDraw?"#extension GL_ANGLE_multi_draw : require":""].filter(Ga).join(`
`)}function eb(i){let e=[];for(let t in i){let n=i[t];n!==!1&&e.push("#define "+t+" "+n)}return e.join(`
`)}function tb(i,e){let t={},n=i.getProgramParameter(e,i.ACTIVE_ATTRIBUTES);for(let s=0;s<n;s++){let r=i.getActiveAttrib(e,s),o=r.name,a=1;r.type===i.FLOAT_MAT2&&(a=2),r.type===i.FLOAT_MAT3&&(a=3),r.type===i.FLOAT_MAT4&&(a=4),t[o]={type:r.type,location:i.getAttribLocation(e,o),locationSize:a}}return t}function Ga(i){return i!==""}function hg(i,e){let t=e.numSpotLightShadows+e.numSpotLightMaps-e.numSpotLightShadowsWithMaps;return i.replace(/NUM_SUN_LIGHTS/g,e.numSunLights).replace(/NUM_DIR_LIGHTS/g,e.numDirLights).replace(/NUM_SPOT_LIGHTS/g,e.numSpotLights).replace(/NUM_SPOT_LIGHT_MAPS/g,e.numSpotLightMaps).replace(/NUM_SPOT_LIGHT_COORDS/g,t).replace(/NUM_RECT_AREA_LIGHTS/g,e.numRectAreaLights).replace(/NUM_POINT_LIGHTS/g,e.numPointLights).replace(/NUM_HEMI_LIGHTS/g,e.numHemiLights).replace(/NUM_SUN_LIGHT_SHADOWS/g,e.numSunLightShadows).replace(/NUM_DIR_LIGHT_SHADOWS/g,e.numDirLightShadows).replace(/NUM_SPOT_LIGHT_SHADOWS_WITH_MAPS/g,e.numSpotLightShadowsWithMaps).replace(/NUM_SPOT_LIGHT_SHADOWS/g,e.numSpotLightShadows).replace(/NUM_POINT_LIGHT_SHADOWS/g,e.numPointLightShadows).replace(/NUM_LIGHT_PROBE_GRIDS/g,e.numLightProbeGrids)}function ug(i,e){return i.replace(/NUM_CLIPPING_PLANES/g,e.numClippingPlanes).replace(/UNION_CLIPPING_PLANES/g,e.numClippingPlanes-e.numClipIntersection)}var nb=/^[ \t]*#include +<([\w\d./]+)>/gm;function $d(i){return i.replace(nb,ib)}function ib(i,e){let t=yt[e];if(t===void 0)throw new Error("THREE.WebGLProgram: Can not resolve #include <"+e+">");return $d(t)}var sb=/#pragma unroll_loop_start\s+for\s*\(\s*int\s+i\s*=\s*(\d+)\s*;\s*i\s*<\s*(\d+)\s*;\s*i\s*\+\+\s*\)\s*{([\s\S]+?)}\s+#pragma unroll_loop_end/g;function dg(i){return i.replace(sb,rb)}function rb(i,e,t,n){let s="";for(let r=parseInt(e);r<parseInt(t);r++)s+=n.replace(/\[\s*i\s*\]/g,"[ "+r+" ]").replace(/UNROLLED_LOOP_INDEX/g,r);return s}function fg(i){let e=`precision ${i.precision} float;
	precision ${i.precision} int;
	precision ${i.precision} sampler2D;
	precision ${i.precision} samplerCube;
	precision ${i.precision} sampler3D;
	precision ${i.precision} sampler2DArray;
	precision ${i.precision} sampler2DShadow;
	precision ${i.precision} samplerCubeShadow;
	precision ${i.precision} sampler2DArrayShadow;
	precision ${i.precision} isampler2D;
	precision ${i.precision} isampler3D;
	precision ${i.precision} isamplerCube;
	precision ${i.precision} isampler2DArray;
	precision ${i.precision} usampler2D;
	precision ${i.precision} usampler3D;
	precision ${i.precision} usamplerCube;
	precision ${i.precision} usampler2DArray;
	`;return i.precision==="highp"?e+=`
#define HIGH_PRECISION`:i.precision==="mediump"?e+=`
#define MEDIUM_PRECISION`:i.precision==="lowp"&&(e+=`
#define LOW_PRECISION`),e}var ob={[Da]:"SHADOWMAP_TYPE_PCF",[mo]:"SHADOWMAP_TYPE_VSM"};function ab(i){return ob[i.shadowMapType]||"SHADOWMAP_TYPE_BASIC"}var lb={[_o]:"ENVMAP_MODE_REFRACTION"};function cb(i){return i.envMap===!1?"ENVMAP_MODE_REFLECTION":lb[i.envMapMode]||"ENVMAP_MODE_REFLECTION"}var hb={[Rc]:"ENVMAP_BLENDING_MULTIPLY",[wm]:"ENVMAP_BLENDING_MIX",[Em]:"ENVMAP_BLENDING_ADD"};function ub(i){return i.envMap===!1?"ENVMAP_BLENDING_NONE":hb[i.combine]||"ENVMAP_BLENDING_NONE"}function db(i,e,t,n){let s=i.getContext(),r=t.defines,o=t.vertexShader,a=t.fragmentShader,l=ab(t),c=t.envMapPMREM===!0?"ENVMAP_TYPE_PMREM":"ENVMAP_TYPE_CUBE",h=cb(t),d=ub(t),u=jM(t),f=eb(r),p=s.createProgram(),x,m,g=t.glslVersion?"#version "+t.glslVersion+`
`:"";t.isRawShaderMaterial?(x=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Ga).join(`
`),x.length>0&&(x+=`
`),m=["#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f].filter(Ga).join(`
`),m.length>0&&(m+=`
`)):(x=[fg(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.extensionClipCullDistance?"#define USE_CLIP_DISTANCE":"",t.batching?"#define USE_BATCHING":"",t.batchingColor?"#define USE_BATCHING_COLOR":"",t.instancing?"#define USE_INSTANCING":"",t.instancingColor?"#define USE_INSTANCING_COLOR":"",t.instancingMorph?"#define USE_INSTANCING_MORPH":"",t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.map?"#define USE_MAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+h:"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.displacementMap?"#define USE_DISPLACEMENTMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.mapUv?"#define MAP_UV "+t.mapUv:"",t.alphaMapUv?"#define ALPHAMAP_UV "+t.alphaMapUv:"",t.lightMapUv?"#define LIGHTMAP_UV "+t.lightMapUv:"",t.aoMapUv?"#define AOMAP_UV "+t.aoMapUv:"",t.emissiveMapUv?"#define EMISSIVEMAP_UV "+t.emissiveMapUv:"",t.bumpMapUv?"#define BUMPMAP_UV "+t.bumpMapUv:"",t.normalMapUv?"#define NORMALMAP_UV "+t.normalMapUv:"",t.displacementMapUv?"#define DISPLACEMENTMAP_UV "+t.displacementMapUv:"",t.metalnessMapUv?"#define METALNESSMAP_UV "+t.metalnessMapUv:"",t.roughnessMapUv?"#define ROUGHNESSMAP_UV "+t.roughnessMapUv:"",t.anisotropyMapUv?"#define ANISOTROPYMAP_UV "+t.anisotropyMapUv:"",t.clearcoatMapUv?"#define CLEARCOATMAP_UV "+t.clearcoatMapUv:"",t.clearcoatNormalMapUv?"#define CLEARCOAT_NORMALMAP_UV "+t.clearcoatNormalMapUv:"",t.clearcoatRoughnessMapUv?"#define CLEARCOAT_ROUGHNESSMAP_UV "+t.clearcoatRoughnessMapUv:"",t.diffuseRoughnessMapUv?"#define DIFFUSE_ROUGHNESSMAP_UV "+t.diffuseRoughnessMapUv:"",t.iridescenceMapUv?"#define IRIDESCENCEMAP_UV "+t.iridescenceMapUv:"",t.iridescenceThicknessMapUv?"#define IRIDESCENCE_THICKNESSMAP_UV "+t.iridescenceThicknessMapUv:"",t.sheenColorMapUv?"#define SHEEN_COLORMAP_UV "+t.sheenColorMapUv:"",t.sheenRoughnessMapUv?"#define SHEEN_ROUGHNESSMAP_UV "+t.sheenRoughnessMapUv:"",t.specularMapUv?"#define SPECULARMAP_UV "+t.specularMapUv:"",t.specularColorMapUv?"#define SPECULAR_COLORMAP_UV "+t.specularColorMapUv:"",t.specularIntensityMapUv?"#define SPECULAR_INTENSITYMAP_UV "+t.specularIntensityMapUv:"",t.transmissionMapUv?"#define TRANSMISSIONMAP_UV "+t.transmissionMapUv:"",t.thicknessMapUv?"#define THICKNESSMAP_UV "+t.thicknessMapUv:"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexNormals?"#define HAS_NORMAL":"",t.vertexColors?"#define USE_COLOR":"",t.vertexAlphas?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.flatShading?"#define FLAT_SHADED":"",t.skinning?"#define USE_SKINNING":"",t.morphTargets?"#define USE_MORPHTARGETS":"",t.morphNormals&&t.flatShading===!1?"#define USE_MORPHNORMALS":"",t.morphColors?"#define USE_MORPHCOLORS":"",t.morphTargetsCount>0?"#define MORPHTARGETS_TEXTURE_STRIDE "+t.morphTextureStride:"",t.morphTargetsCount>0?"#define MORPHTARGETS_COUNT "+t.morphTargetsCount:"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.sizeAttenuation?"#define USE_SIZEATTENUATION":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 modelMatrix;","uniform mat4 modelViewMatrix;","uniform mat4 projectionMatrix;","uniform mat4 viewMatrix;","uniform mat3 normalMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;","#ifdef USE_INSTANCING","	attribute mat4 instanceMatrix;","#endif","#ifdef USE_INSTANCING_COLOR","	attribute vec3 instanceColor;","#endif","#ifdef USE_INSTANCING_MORPH","	uniform sampler2D morphTexture;","#endif","attribute vec3 position;","attribute vec3 normal;","attribute vec2 uv;","#ifdef USE_UV1","	attribute vec2 uv1;","#endif","#ifdef USE_UV2","	attribute vec2 uv2;","#endif","#ifdef USE_UV3","	attribute vec2 uv3;","#endif","#ifdef USE_TANGENT","	attribute vec4 tangent;","#endif","#if defined( USE_COLOR_ALPHA )","	attribute vec4 color;","#elif defined( USE_COLOR )","	attribute vec3 color;","#endif","#ifdef USE_SKINNING","	attribute vec4 skinIndex;","	attribute vec4 skinWeight;","#endif",`
`].filter(Ga).join(`
`),m=[fg(t),"#define SHADER_TYPE "+t.shaderType,"#define SHADER_NAME "+t.shaderName,f,t.useFog&&t.fog?"#define USE_FOG":"",t.useFog&&t.fogExp2?"#define FOG_EXP2":"",t.alphaToCoverage?"#define ALPHA_TO_COVERAGE":"",t.map?"#define USE_MAP":"",t.matcap?"#define USE_MATCAP":"",t.envMap?"#define USE_ENVMAP":"",t.envMap?"#define "+c:"",t.envMap?"#define "+h:"",t.envMap?"#define "+d:"",t.envMapPMREM?"#define ENVMAP_MAX_LOD "+t.envMapMaxLod+".0":"",t.envMapPMREM?"#define ENVMAP_SIZE "+t.envMapSize+".0":"",t.lightMap?"#define USE_LIGHTMAP":"",t.aoMap?"#define USE_AOMAP":"",t.bumpMap?"#define USE_BUMPMAP":"",t.normalMap?"#define USE_NORMALMAP":"",t.normalMapObjectSpace?"#define USE_NORMALMAP_OBJECTSPACE":"",t.normalMapTangentSpace?"#define USE_NORMALMAP_TANGENTSPACE":"",t.packedNormalMap?"#define USE_PACKED_NORMALMAP":"",t.emissiveMap?"#define USE_EMISSIVEMAP":"",t.anisotropy?"#define USE_ANISOTROPY":"",t.anisotropyMap?"#define USE_ANISOTROPYMAP":"",t.clearcoat?"#define USE_CLEARCOAT":"",t.clearcoatMap?"#define USE_CLEARCOATMAP":"",t.clearcoatRoughnessMap?"#define USE_CLEARCOAT_ROUGHNESSMAP":"",t.clearcoatNormalMap?"#define USE_CLEARCOAT_NORMALMAP":"",t.diffuseRoughness?"#define USE_DIFFUSE_ROUGHNESS":"",t.diffuseRoughnessMap?"#define USE_DIFFUSE_ROUGHNESSMAP":"",t.dispersion?"#define USE_DISPERSION":"",t.retroreflection?"#define USE_RETROREFLECTION":"",t.iridescence?"#define USE_IRIDESCENCE":"",t.iridescenceMap?"#define USE_IRIDESCENCEMAP":"",t.iridescenceThicknessMap?"#define USE_IRIDESCENCE_THICKNESSMAP":"",t.specularMap?"#define USE_SPECULARMAP":"",t.specularColorMap?"#define USE_SPECULAR_COLORMAP":"",t.specularIntensityMap?"#define USE_SPECULAR_INTENSITYMAP":"",t.roughnessMap?"#define USE_ROUGHNESSMAP":"",t.metalnessMap?"#define USE_METALNESSMAP":"",t.alphaMap?"#define USE_ALPHAMAP":"",t.alphaTest?"#define USE_ALPHATEST":"",t.alphaHash?"#define USE_ALPHAHASH":"",t.sheen?"#define USE_SHEEN":"",t.sheenColorMap?"#define USE_SHEEN_COLORMAP":"",t.sheenRoughnessMap?"#define USE_SHEEN_ROUGHNESSMAP":"",t.transmission?"#define USE_TRANSMISSION":"",t.transmissionMap?"#define USE_TRANSMISSIONMAP":"",t.thicknessMap?"#define USE_THICKNESSMAP":"",t.vertexTangents&&t.flatShading===!1?"#define USE_TANGENT":"",t.vertexColors||t.instancingColor?"#define USE_COLOR":"",t.vertexAlphas||t.batchingColor?"#define USE_COLOR_ALPHA":"",t.vertexUv1s?"#define USE_UV1":"",t.vertexUv2s?"#define USE_UV2":"",t.vertexUv3s?"#define USE_UV3":"",t.pointsUvs?"#define USE_POINTS_UV":"",t.gradientMap?"#define USE_GRADIENTMAP":"",t.flatShading?"#define FLAT_SHADED":"",t.doubleSided?"#define DOUBLE_SIDED":"",t.flipSided?"#define FLIP_SIDED":"",t.shadowMapEnabled?"#define USE_SHADOWMAP":"",t.shadowMapEnabled?"#define "+l:"",t.premultipliedAlpha?"#define PREMULTIPLIED_ALPHA":"",t.numLightProbes>0?"#define USE_LIGHT_PROBES":"",t.decodeVideoTexture?"#define DECODE_VIDEO_TEXTURE":"",t.decodeVideoTextureEmissive?"#define DECODE_VIDEO_TEXTURE_EMISSIVE":"",t.logarithmicDepthBuffer?"#define USE_LOGARITHMIC_DEPTH_BUFFER":"",t.reversedDepthBuffer?"#define USE_REVERSED_DEPTH_BUFFER":"","uniform mat4 viewMatrix;","uniform vec3 cameraPosition;","uniform bool isOrthographic;",t.toneMapping!==Ki?"#define TONE_MAPPING":"",t.toneMapping!==Ki?yt.tonemapping_pars_fragment:"",t.toneMapping!==Ki?KM("toneMapping",t.toneMapping):"",t.dithering?"#define DITHERING":"",t.opaque?"#define OPAQUE":"",yt.colorspace_pars_fragment,ZM("linearToOutputTexel",t.outputColorSpace),QM(),t.useDepthPacking?"#define DEPTH_PACKING "+t.depthPacking:"",`
`].filter(Ga).join(`
`)),o=$d(o),o=hg(o,t),o=ug(o,t),a=$d(a),a=hg(a,t),a=ug(a,t),o=dg(o),a=dg(a),t.isRawShaderMaterial!==!0&&(g=`#version 300 es
`,x=[u,"#define attribute in","#define varying out","#define texture2D texture"].join(`
`)+`
`+x,m=["#define varying in",t.glslVersion===Ld?"":"layout(location = 0) out highp vec4 pc_fragColor;",t.glslVersion===Ld?"":"#define gl_FragColor pc_fragColor","#define gl_FragDepthEXT gl_FragDepth","#define texture2D texture","#define textureCube texture","#define texture2DProj textureProj","#define texture2DLodEXT textureLod","#define texture2DProjLodEXT textureProjLod","#define textureCubeLodEXT textureLod","#define texture2DGradEXT textureGrad","#define texture2DProjGradEXT textureProjGrad","#define textureCubeGradEXT textureGrad"].join(`
`)+`
`+m);let S=g+x+o,T=g+m+a,y=ag(s,s.VERTEX_SHADER,S),C=ag(s,s.FRAGMENT_SHADER,T);s.attachShader(p,y),s.attachShader(p,C),t.index0AttributeName!==void 0?s.bindAttribLocation(p,0,t.index0AttributeName):t.hasPositionAttribute===!0&&s.bindAttribLocation(p,0,"position"),s.linkProgram(p);function A(N){if(i.debug.checkShaderErrors){let I=s.getProgramInfoLog(p)||"",G=s.getShaderInfoLog(y)||"",W=s.getShaderInfoLog(C)||"",L=I.trim(),H=G.trim(),Y=W.trim(),z=!0,ce=!0;if(s.getProgramParameter(p,s.LINK_STATUS)===!1)if(z=!1,typeof i.debug.onShaderError=="function")i.debug.onShaderError(s,p,y,C);else{let J=cg(s,y,"vertex"),j=cg(s,C,"fragment");at("WebGLProgram: Shader Error "+s.getError()+" - VALIDATE_STATUS "+s.getProgramParameter(p,s.VALIDATE_STATUS)+`

Material Name: `+N.name+`
Material Type: `+N.type+`

Program Info Log: `+L+`
`+J+`
`+j)}else L!==""?tt("WebGLProgram: Program Info Log:",L):(H===""||Y==="")&&(ce=!1);ce&&(N.diagnostics={runnable:z,programLog:L,vertexShader:{log:H,prefix:x},fragmentShader:{log:Y,prefix:m}})}s.deleteShader(y),s.deleteShader(C),v=new xo(s,p),E=tb(s,p)}let v;this.getUniforms=function(){return v===void 0&&A(this),v};let E;this.getAttributes=function(){return E===void 0&&A(this),E};let k=t.rendererExtensionParallelShaderCompile===!1;return this.isReady=function(){return k===!1&&(k=s.getProgramParameter(p,XM)),k},this.destroy=function(){n.releaseStatesOfProgram(this),s.deleteProgram(p),this.program=void 0},this.type=t.shaderType,this.name=t.shaderName,this.id=qM++,this.cacheKey=e,this.usedTimes=1,this.program=p,this.vertexShader=y,this.fragmentShader=C,this}var fb=0,Zd=class{constructor(){this.shaderCache=new Map,this.materialCache=new Map}update(e,t,n){let s=this._getShaderCacheForMaterial(e);return s.has(t)===!1&&(s.add(t),t.usedTimes++),s.has(n)===!1&&(s.add(n),n.usedTimes++),this}remove(e){let t=this.materialCache.get(e);for(let n of t)n.usedTimes--,n.usedTimes===0&&this.shaderCache.delete(n.code);return this.materialCache.delete(e),this}getVertexShaderStage(e){return this._getShaderStage(e.vertexShader)}getFragmentShaderStage(e){return this._getShaderStage(e.fragmentShader)}dispose(){this.shaderCache.clear(),this.materialCache.clear()}_getShaderCacheForMaterial(e){let t=this.materialCache,n=t.get(e);return n===void 0&&(n=new Set,t.set(e,n)),n}_getShaderStage(e){let t=this.shaderCache,n=t.get(e);return n===void 0&&(n=new Jd(e),t.set(e,n)),n}},Jd=class{constructor(e){this.id=fb++,this.code=e,this.usedTimes=0}};function pb(i){return i===Gs||i===ka||i===za}function mb(i,e,t,n,s,r){let o=new la,a=new Zd,l=new Set,c=[],h=new Map,d=n.logarithmicDepthBuffer,u={MeshDepthMaterial:"depth",MeshDistanceMaterial:"distance",MeshNormalMaterial:"normal",MeshBasicMaterial:"basic",MeshLambertMaterial:"lambert",MeshPhongMaterial:"phong",MeshToonMaterial:"toon",MeshStandardMaterial:"physical",MeshPhysicalMaterial:"physical",MeshMatcapMaterial:"matcap",LineBasicMaterial:"basic",LineDashedMaterial:"dashed",PointsMaterial:"points",ShadowMaterial:"shadow",SpriteMaterial:"sprite"};function f(v){return l.add(v),v===0?"uv":`uv${v}`}function p(v,E,k,N,I,G){let W=N.fog,L=I.geometry,H=v.isMeshStandardMaterial||v.isMeshLambertMaterial||v.isMeshPhongMaterial?N.environment:null,Y=v.isMeshStandardMaterial||v.isMeshLambertMaterial&&!v.envMap||v.isMeshPhongMaterial&&!v.envMap,z=e.get(v.envMap||H,Y),ce=u[v.type],J=n.precision;v.precision!==null&&(J=n.getMaxPrecision(v.precision),J!==v.precision&&tt("WebGLProgram.getParameters:",v.precision,"not supported, using",J,"instead."));let j=L.morphAttributes.position||L.morphAttributes.normal||L.morphAttributes.color,te=j!==void 0?j.length:0,fe=0;L.morphAttributes.position!==void 0&&(fe=1),L.morphAttributes.normal!==void 0&&(fe=2),L.morphAttributes.color!==void 0&&(fe=3);let he,ee,ge,ve;if(ce){let Ne=ji[ce];he=Ne.vertexShader,ee=Ne.fragmentShader}else{he=v.vertexShader,ee=v.fragmentShader;let Ne=a.getVertexShaderStage(v),_t=a.getFragmentShaderStage(v);a.update(v,Ne,_t),ge=Ne.id,ve=_t.id}let Ie=i.getRenderTarget(),be=i.state.buffers.depth.getReversed(),Ge=I.isInstancedMesh===!0,st=I.isBatchedMesh===!0,Je=!!v.map,rt=!!v.matcap,it=!!z,oe=it&&z.isPMREMTexture===!0,xe=!!v.aoMap,_e=!!v.lightMap,Be=!!v.bumpMap&&v.wireframe===!1,Le=!!v.normalMap,nt=!!v.displacementMap,ke=!!v.emissiveMap,gt=!!v.metalnessMap,dt=!!v.roughnessMap,vt=v.anisotropy>0,U=v.clearcoat>0,Se=v.diffuseRoughness>0,Xe=v.dispersion>0,ht=v.retroreflectivity>0,we=v.iridescence>0,Nt=v.sheen>0,$e=v.transmission>0,je=vt&&!!v.anisotropyMap,R=U&&!!v.clearcoatMap,M=U&&!!v.clearcoatNormalMap,q=U&&!!v.clearcoatRoughnessMap,de=Se&&!!v.diffuseRoughnessMap,ae=we&&!!v.iridescenceMap,Me=we&&!!v.iridescenceThicknessMap,Ee=Nt&&!!v.sheenColorMap,ne=Nt&&!!v.sheenRoughnessMap,se=!!v.specularMap,me=!!v.specularColorMap,O=!!v.specularIntensityMap,re=$e&&!!v.transmissionMap,ie=$e&&!!v.thicknessMap,Re=!!v.gradientMap,ye=!!v.alphaMap,Ae=v.alphaTest>0,Ke=!!v.alphaHash,lt=!!v.extensions,ue=Ki;v.toneMapped&&(Ie===null||Ie.isXRRenderTarget===!0)&&(ue=i.toneMapping);let qe=oe?z.isCompressedCubeTexture?z.image[0].mipmaps:z.mipmaps:null,ct={shaderID:ce,shaderType:v.type,shaderName:v.name,vertexShader:he,fragmentShader:ee,defines:v.defines,customVertexShaderID:ge,customFragmentShaderID:ve,isRawShaderMaterial:v.isRawShaderMaterial===!0,glslVersion:v.glslVersion,precision:J,batching:st,batchingColor:st&&I._colorsTexture!==null,instancing:Ge,instancingColor:Ge&&I.instanceColor!==null,instancingMorph:Ge&&I.morphTexture!==null,outputColorSpace:Ie===null?i.outputColorSpace:Ie.isXRRenderTarget===!0?Ie.texture.colorSpace:Tt.workingColorSpace,alphaToCoverage:!!v.alphaToCoverage,map:Je,matcap:rt,envMap:it,envMapMode:it&&z.mapping,envMapPMREM:oe,envMapMaxLod:oe?qe.length-1:null,envMapSize:oe?qe[0].width:null,aoMap:xe,lightMap:_e,bumpMap:Be,normalMap:Le,displacementMap:nt,emissiveMap:ke,normalMapObjectSpace:Le&&v.normalMapType===Rm,normalMapTangentSpace:Le&&v.normalMapType===ph,packedNormalMap:Le&&v.normalMapType===ph&&pb(v.normalMap.format),metalnessMap:gt,roughnessMap:dt,anisotropy:vt,anisotropyMap:je,clearcoat:U,clearcoatMap:R,clearcoatNormalMap:M,clearcoatRoughnessMap:q,diffuseRoughness:Se,diffuseRoughnessMap:de,dispersion:Xe,retroreflection:ht,iridescence:we,iridescenceMap:ae,iridescenceThicknessMap:Me,sheen:Nt,sheenColorMap:Ee,sheenRoughnessMap:ne,specularMap:se,specularColorMap:me,specularIntensityMap:O,transmission:$e,transmissionMap:re,thicknessMap:ie,gradientMap:Re,opaque:v.transparent===!1&&v.blending===go&&v.alphaToCoverage===!1,alphaMap:ye,alphaTest:Ae,alphaHash:Ke,combine:v.combine,mapUv:Je&&f(v.map.channel),aoMapUv:xe&&f(v.aoMap.channel),lightMapUv:_e&&f(v.lightMap.channel),bumpMapUv:Be&&f(v.bumpMap.channel),normalMapUv:Le&&f(v.normalMap.channel),displacementMapUv:nt&&f(v.displacementMap.channel),emissiveMapUv:ke&&f(v.emissiveMap.channel),metalnessMapUv:gt&&f(v.metalnessMap.channel),roughnessMapUv:dt&&f(v.roughnessMap.channel),anisotropyMapUv:je&&f(v.anisotropyMap.channel),clearcoatMapUv:R&&f(v.clearcoatMap.channel),clearcoatNormalMapUv:M&&f(v.clearcoatNormalMap.channel),clearcoatRoughnessMapUv:q&&f(v.clearcoatRoughnessMap.channel),diffuseRoughnessMapUv:de&&f(v.diffuseRoughnessMap.channel),iridescenceMapUv:ae&&f(v.iridescenceMap.channel),iridescenceThicknessMapUv:Me&&f(v.iridescenceThicknessMap.channel),sheenColorMapUv:Ee&&f(v.sheenColorMap.channel),sheenRoughnessMapUv:ne&&f(v.sheenRoughnessMap.channel),specularMapUv:se&&f(v.specularMap.channel),specularColorMapUv:me&&f(v.specularColorMap.channel),specularIntensityMapUv:O&&f(v.specularIntensityMap.channel),transmissionMapUv:re&&f(v.transmissionMap.channel),thicknessMapUv:ie&&f(v.thicknessMap.channel),alphaMapUv:ye&&f(v.alphaMap.channel),vertexTangents:!!L.attributes.tangent&&(Le||vt),vertexNormals:!!L.attributes.normal,vertexColors:v.vertexColors,vertexAlphas:v.vertexColors===!0&&!!L.attributes.color&&L.attributes.color.itemSize===4,pointsUvs:I.isPoints===!0&&!!L.attributes.uv&&(Je||ye),fog:!!W,useFog:v.fog===!0,fogExp2:!!W&&W.isFogExp2,flatShading:v.wireframe===!1&&(v.flatShading===!0||L.attributes.normal===void 0&&Le===!1&&(v.isMeshLambertMaterial||v.isMeshPhongMaterial||v.isMeshStandardMaterial||v.isMeshPhysicalMaterial)),sizeAttenuation:v.sizeAttenuation===!0,logarithmicDepthBuffer:d,reversedDepthBuffer:be,skinning:I.isSkinnedMesh===!0,hasPositionAttribute:L.attributes.position!==void 0,morphTargets:L.morphAttributes.position!==void 0,morphNormals:L.morphAttributes.normal!==void 0,morphColors:L.morphAttributes.color!==void 0,morphTargetsCount:te,morphTextureStride:fe,numSunLights:E.sun.length,numDirLights:E.directional.length,numPointLights:E.point.length,numSpotLights:E.spot.length,numSpotLightMaps:E.spotLightMap.length,numRectAreaLights:E.rectArea.length,numHemiLights:E.hemi.length,numSunLightShadows:E.sunShadowMap.length,numDirLightShadows:E.directionalShadowMap.length,numPointLightShadows:E.pointShadowMap.length,numSpotLightShadows:E.spotShadowMap.length,numSpotLightShadowsWithMaps:E.numSpotLightShadowsWithMaps,numLightProbes:E.numLightProbes,numLightProbeGrids:G.filter(Ne=>Ne.texture!==null).length,numClippingPlanes:r.numPlanes,numClipIntersection:r.numIntersection,dithering:v.dithering,shadowMapEnabled:i.shadowMap.enabled&&k.length>0,shadowMapType:i.shadowMap.type,toneMapping:ue,decodeVideoTexture:Je&&v.map.isVideoTexture===!0&&Tt.getTransfer(v.map.colorSpace)===Ut,decodeVideoTextureEmissive:ke&&v.emissiveMap.isVideoTexture===!0&&Tt.getTransfer(v.emissiveMap.colorSpace)===Ut,premultipliedAlpha:v.premultipliedAlpha,doubleSided:v.side===ci,flipSided:v.side===Kn,useDepthPacking:v.depthPacking>=0,depthPacking:v.depthPacking||0,index0AttributeName:v.index0AttributeName,extensionClipCullDistance:lt&&v.extensions.clipCullDistance===!0&&t.has("WEBGL_clip_cull_distance"),extensionMultiDraw:(lt&&v.extensions.multiDraw===!0||st)&&t.has("WEBGL_multi_draw"),rendererExtensionParallelShaderCompile:t.has("KHR_parallel_shader_compile"),customProgramCacheKey:v.customProgramCacheKey()};return ct.vertexUv1s=l.has(1),ct.vertexUv2s=l.has(2),ct.vertexUv3s=l.has(3),l.clear(),ct}function x(v){let E=[];if(v.shaderID?E.push(v.shaderID):(E.push(v.customVertexShaderID),E.push(v.customFragmentShaderID)),v.defines!==void 0)for(let k in v.defines)E.push(k),E.push(v.defines[k]);return v.isRawShaderMaterial===!1&&(m(E,v),g(E,v),E.push(i.outputColorSpace)),E.push(v.customProgramCacheKey),E.join()}function m(v,E){v.push(E.precision),v.push(E.outputColorSpace),v.push(E.envMapMode),v.push(E.envMapPMREM),v.push(E.envMapMaxLod),v.push(E.envMapSize),v.push(E.mapUv),v.push(E.alphaMapUv),v.push(E.lightMapUv),v.push(E.aoMapUv),v.push(E.bumpMapUv),v.push(E.normalMapUv),v.push(E.displacementMapUv),v.push(E.emissiveMapUv),v.push(E.metalnessMapUv),v.push(E.roughnessMapUv),v.push(E.anisotropyMapUv),v.push(E.clearcoatMapUv),v.push(E.clearcoatNormalMapUv),v.push(E.clearcoatRoughnessMapUv),v.push(E.diffuseRoughnessMapUv),v.push(E.iridescenceMapUv),v.push(E.iridescenceThicknessMapUv),v.push(E.sheenColorMapUv),v.push(E.sheenRoughnessMapUv),v.push(E.specularMapUv),v.push(E.specularColorMapUv),v.push(E.specularIntensityMapUv),v.push(E.transmissionMapUv),v.push(E.thicknessMapUv),v.push(E.combine),v.push(E.fogExp2),v.push(E.sizeAttenuation),v.push(E.morphTargetsCount),v.push(E.numSunLights),v.push(E.numDirLights),v.push(E.numPointLights),v.push(E.numSpotLights),v.push(E.numSpotLightMaps),v.push(E.numHemiLights),v.push(E.numRectAreaLights),v.push(E.numSunLightShadows),v.push(E.numDirLightShadows),v.push(E.numPointLightShadows),v.push(E.numSpotLightShadows),v.push(E.numSpotLightShadowsWithMaps),v.push(E.numLightProbes),v.push(E.numLightProbeGrids),v.push(E.shadowMapType),v.push(E.toneMapping),v.push(E.numClippingPlanes),v.push(E.numClipIntersection),v.push(E.depthPacking)}function g(v,E){o.disableAll(),E.instancing&&o.enable(0),E.instancingColor&&o.enable(1),E.instancingMorph&&o.enable(2),E.matcap&&o.enable(3),E.envMap&&o.enable(4),E.normalMapObjectSpace&&o.enable(5),E.normalMapTangentSpace&&o.enable(6),E.clearcoat&&o.enable(7),E.iridescence&&o.enable(8),E.alphaTest&&o.enable(9),E.vertexColors&&o.enable(10),E.vertexAlphas&&o.enable(11),E.vertexUv1s&&o.enable(12),E.vertexUv2s&&o.enable(13),E.vertexUv3s&&o.enable(14),E.vertexTangents&&o.enable(15),E.anisotropy&&o.enable(16),E.alphaHash&&o.enable(17),E.batching&&o.enable(18),E.dispersion&&o.enable(19),E.retroreflection&&o.enable(24),E.diffuseRoughness&&o.enable(25),E.batchingColor&&o.enable(20),E.gradientMap&&o.enable(21),E.packedNormalMap&&o.enable(22),E.vertexNormals&&o.enable(23),v.push(o.mask),o.disableAll(),E.fog&&o.enable(0),E.useFog&&o.enable(1),E.flatShading&&o.enable(2),E.logarithmicDepthBuffer&&o.enable(3),E.reversedDepthBuffer&&o.enable(4),E.skinning&&o.enable(5),E.morphTargets&&o.enable(6),E.morphNormals&&o.enable(7),E.morphColors&&o.enable(8),E.premultipliedAlpha&&o.enable(9),E.shadowMapEnabled&&o.enable(10),E.doubleSided&&o.enable(11),E.flipSided&&o.enable(12),E.useDepthPacking&&o.enable(13),E.dithering&&o.enable(14),E.transmission&&o.enable(15),E.sheen&&o.enable(16),E.opaque&&o.enable(17),E.pointsUvs&&o.enable(18),E.decodeVideoTexture&&o.enable(19),E.decodeVideoTextureEmissive&&o.enable(20),E.alphaToCoverage&&o.enable(21),E.numLightProbeGrids>0&&o.enable(22),E.hasPositionAttribute&&o.enable(23),v.push(o.mask)}function S(v){let E=u[v.type],k;if(E){let N=ji[E];k=$m.clone(N.uniforms)}else k=v.uniforms;return k}function T(v,E){let k=h.get(E);return k!==void 0?++k.usedTimes:(k=new db(i,E,v,s),c.push(k),h.set(E,k)),k}function y(v){if(--v.usedTimes===0){let E=c.indexOf(v);c[E]=c[c.length-1],c.pop(),h.delete(v.cacheKey),v.destroy()}}function C(v){a.remove(v)}function A(){a.dispose()}return{getParameters:p,getProgramCacheKey:x,getUniforms:S,acquireProgram:T,releaseProgram:y,releaseShaderCache:C,programs:c,dispose:A}}function gb(){let i=new WeakMap;function e(o){return i.has(o)}function t(o){let a=i.get(o);return a===void 0&&(a={},i.set(o,a)),a}function n(o){i.delete(o)}function s(o,a,l){i.get(o)[a]=l}function r(){i=new WeakMap}return{has:e,get:t,remove:n,update:s,dispose:r}}function _b(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.material.id!==e.material.id?i.material.id-e.material.id:i.materialVariant!==e.materialVariant?i.materialVariant-e.materialVariant:i.z!==e.z?i.z-e.z:i.id-e.id}function pg(i,e){return i.groupOrder!==e.groupOrder?i.groupOrder-e.groupOrder:i.renderOrder!==e.renderOrder?i.renderOrder-e.renderOrder:i.z!==e.z?e.z-i.z:i.id-e.id}function mg(){let i=[],e=0,t=[],n=[],s=[];function r(){e=0,t.length=0,n.length=0,s.length=0}function o(u){let f=0;return u.isInstancedMesh&&(f+=2),u.isSkinnedMesh&&(f+=1),f}function a(u,f,p,x,m,g){let S=i[e];return S===void 0?(S={id:u.id,object:u,geometry:f,material:p,materialVariant:o(u),groupOrder:x,renderOrder:u.renderOrder,z:m,group:g},i[e]=S):(S.id=u.id,S.object=u,S.geometry=f,S.material=p,S.materialVariant=o(u),S.groupOrder=x,S.renderOrder=u.renderOrder,S.z=m,S.group=g),e++,S}function l(u,f,p,x,m,g,S){S.reversedDepth===!0&&(m=-m);let T=a(u,f,p,x,m,g);p.transmission>0?n.push(T):p.transparent===!0?s.push(T):t.push(T)}function c(u,f,p,x,m,g){let S=a(u,f,p,x,m,g);p.transmission>0?n.unshift(S):p.transparent===!0?s.unshift(S):t.unshift(S)}function h(u,f){t.length>1&&t.sort(u||_b),n.length>1&&n.sort(f||pg),s.length>1&&s.sort(f||pg)}function d(){for(let u=e,f=i.length;u<f;u++){let p=i[u];if(p.id===null)break;p.id=null,p.object=null,p.geometry=null,p.material=null,p.group=null}}return{opaque:t,transmissive:n,transparent:s,init:r,push:l,unshift:c,finish:d,sort:h}}function vb(){let i=new WeakMap;function e(n,s){let r=i.get(n),o;return r===void 0?(o=new mg,i.set(n,[o])):s>=r.length?(o=new mg,r.push(o)):o=r[s],o}function t(){i=new WeakMap}return{get:e,dispose:t}}function xb(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={direction:new X,color:new pt};break;case"SpotLight":t={position:new X,direction:new X,color:new pt,distance:0,coneCos:0,penumbraCos:0,decay:0};break;case"PointLight":t={position:new X,color:new pt,distance:0,decay:0};break;case"HemisphereLight":t={direction:new X,skyColor:new pt,groundColor:new pt};break;case"RectAreaLight":t={color:new pt,position:new X,halfWidth:new X,halfHeight:new X};break}return i[e.id]=t,t}}}function yb(){let i={};return{get:function(e){if(i[e.id]!==void 0)return i[e.id];let t;switch(e.type){case"SunLight":case"DirectionalLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new De};break;case"SpotLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new De};break;case"PointLight":t={shadowIntensity:1,shadowBias:0,shadowNormalBias:0,shadowRadius:1,shadowMapSize:new De,shadowCameraNear:1,shadowCameraFar:1e3};break}return i[e.id]=t,t}}}var Sb=0;function Mb(i,e){return(e.castShadow?2:0)-(i.castShadow?2:0)+(e.map?1:0)-(i.map?1:0)}function bb(i){let e=new xb,t=yb(),n={version:0,hash:{sunLength:-1,directionalLength:-1,pointLength:-1,spotLength:-1,rectAreaLength:-1,hemiLength:-1,numSunShadows:-1,numDirectionalShadows:-1,numPointShadows:-1,numSpotShadows:-1,numSpotMaps:-1,numLightProbes:-1},ambient:[0,0,0],probe:[],sun:[],sunShadow:[],sunShadowMap:[],sunShadowMatrix:[],sunShadowCascade:[],directional:[],directionalShadow:[],directionalShadowMap:[],directionalShadowMatrix:[],spot:[],spotLightMap:[],spotShadow:[],spotShadowMap:[],spotLightMatrix:[],rectArea:[],rectAreaLTC1:null,rectAreaLTC2:null,point:[],pointShadow:[],pointShadowMap:[],pointShadowMatrix:[],hemi:[],numSpotLightShadowsWithMaps:0,numLightProbes:0};for(let c=0;c<9;c++)n.probe.push(new X);let s=new X,r=new Ft,o=new Ft;function a(c){let h=0,d=0,u=0;for(let G=0;G<9;G++)n.probe[G].set(0,0,0);let f=0,p=0,x=0,m=0,g=0,S=0,T=0,y=0,C=0,A=0,v=0,E=0,k=0,N=0;c.sort(Mb);for(let G=0,W=c.length;G<W;G++){let L=c[G],H=L.color,Y=L.intensity,z=L.distance,ce=null;if(L.shadow&&L.shadow.map&&(L.shadow.map.texture.format===Gs?ce=L.shadow.map.texture:ce=L.shadow.map.depthTexture||L.shadow.map.texture),L.isAmbientLight)h+=H.r*Y,d+=H.g*Y,u+=H.b*Y;else if(L.isLightProbe){for(let J=0;J<9;J++)n.probe[J].addScaledVector(L.sh.coefficients[J],Y);N++}else if(L.isSunLight){let J=e.get(L);if(J.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let j=L.shadow,te=t.get(L);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize.copy(j.mapSize).multiply(j.getFrameExtents()),n.sunShadow[p]=te,n.sunShadowMap[p]=ce;let fe=j.getViewportCount();for(let he=0;he<fe;he++)n.sunShadowMatrix[x+he]=j.getMatrix(he),n.sunShadowCascade[x+he]=j._cascadeData[he];x+=fe,p++}n.sun[f]=J,f++}else if(L.isDirectionalLight){let J=e.get(L);if(J.color.copy(L.color).multiplyScalar(L.intensity),L.castShadow){let j=L.shadow,te=t.get(L);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize=j.mapSize,n.directionalShadow[m]=te,n.directionalShadowMap[m]=ce,n.directionalShadowMatrix[m]=L.shadow.matrix,C++}n.directional[m]=J,m++}else if(L.isSpotLight){let J=e.get(L);J.position.setFromMatrixPosition(L.matrixWorld),J.color.copy(H).multiplyScalar(Y),J.distance=z,J.coneCos=Math.cos(L.angle),J.penumbraCos=Math.cos(L.angle*(1-L.penumbra)),J.decay=L.decay,n.spot[S]=J;let j=L.shadow;if(L.map&&(n.spotLightMap[E]=L.map,E++,j.updateMatrices(L),L.castShadow&&k++),n.spotLightMatrix[S]=j.matrix,L.castShadow){let te=t.get(L);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize=j.mapSize,n.spotShadow[S]=te,n.spotShadowMap[S]=ce,v++}S++}else if(L.isRectAreaLight){let J=e.get(L);J.color.copy(H).multiplyScalar(Y),J.halfWidth.set(L.width*.5,0,0),J.halfHeight.set(0,L.height*.5,0),n.rectArea[T]=J,T++}else if(L.isPointLight){let J=e.get(L);if(J.color.copy(L.color).multiplyScalar(L.intensity),J.distance=L.distance,J.decay=L.decay,L.castShadow){let j=L.shadow,te=t.get(L);te.shadowIntensity=j.intensity,te.shadowBias=j.bias,te.shadowNormalBias=j.normalBias,te.shadowRadius=j.radius,te.shadowMapSize=j.mapSize,te.shadowCameraNear=j.camera.near,te.shadowCameraFar=j.camera.far,n.pointShadow[g]=te,n.pointShadowMap[g]=ce,n.pointShadowMatrix[g]=L.shadow.matrix,A++}n.point[g]=J,g++}else if(L.isHemisphereLight){let J=e.get(L);J.skyColor.copy(L.color).multiplyScalar(Y),J.groundColor.copy(L.groundColor).multiplyScalar(Y),n.hemi[y]=J,y++}}T>0&&(i.has("OES_texture_float_linear")===!0?(n.rectAreaLTC1=Oe.LTC_FLOAT_1,n.rectAreaLTC2=Oe.LTC_FLOAT_2):(n.rectAreaLTC1=Oe.LTC_HALF_1,n.rectAreaLTC2=Oe.LTC_HALF_2)),n.ambient[0]=h,n.ambient[1]=d,n.ambient[2]=u;let I=n.hash;(I.sunLength!==f||I.directionalLength!==m||I.pointLength!==g||I.spotLength!==S||I.rectAreaLength!==T||I.hemiLength!==y||I.numSunShadows!==p||I.numDirectionalShadows!==C||I.numPointShadows!==A||I.numSpotShadows!==v||I.numSpotMaps!==E||I.numLightProbes!==N)&&(n.sun.length=f,n.directional.length=m,n.spot.length=S,n.rectArea.length=T,n.point.length=g,n.hemi.length=y,n.sunShadow.length=p,n.sunShadowMap.length=p,n.sunShadowMatrix.length=x,n.sunShadowCascade.length=x,n.directionalShadow.length=C,n.directionalShadowMap.length=C,n.directionalShadowMatrix.length=C,n.pointShadow.length=A,n.pointShadowMap.length=A,n.pointShadowMatrix.length=A,n.spotShadow.length=v,n.spotShadowMap.length=v,n.spotLightMatrix.length=v+E-k,n.spotLightMap.length=E,n.numSpotLightShadowsWithMaps=k,n.numLightProbes=N,I.sunLength=f,I.directionalLength=m,I.pointLength=g,I.spotLength=S,I.rectAreaLength=T,I.hemiLength=y,I.numSunShadows=p,I.numDirectionalShadows=C,I.numPointShadows=A,I.numSpotShadows=v,I.numSpotMaps=E,I.numLightProbes=N,n.version=Sb++)}function l(c,h){let d=0,u=0,f=0,p=0,x=0,m=0,g=h.matrixWorldInverse;for(let S=0,T=c.length;S<T;S++){let y=c[S];if(y.isSunLight){let C=n.sun[d];C.direction.setFromMatrixPosition(y.matrixWorld),C.direction.transformDirection(g),d++}else if(y.isDirectionalLight){let C=n.directional[u];C.direction.setFromMatrixPosition(y.matrixWorld),s.setFromMatrixPosition(y.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(g),u++}else if(y.isSpotLight){let C=n.spot[p];C.position.setFromMatrixPosition(y.matrixWorld),C.position.applyMatrix4(g),C.direction.setFromMatrixPosition(y.matrixWorld),s.setFromMatrixPosition(y.target.matrixWorld),C.direction.sub(s),C.direction.transformDirection(g),p++}else if(y.isRectAreaLight){let C=n.rectArea[x];C.position.setFromMatrixPosition(y.matrixWorld),C.position.applyMatrix4(g),o.identity(),r.copy(y.matrixWorld),r.premultiply(g),o.extractRotation(r),C.halfWidth.set(y.width*.5,0,0),C.halfHeight.set(0,y.height*.5,0),C.halfWidth.applyMatrix4(o),C.halfHeight.applyMatrix4(o),x++}else if(y.isPointLight){let C=n.point[f];C.position.setFromMatrixPosition(y.matrixWorld),C.position.applyMatrix4(g),f++}else if(y.isHemisphereLight){let C=n.hemi[m];C.direction.setFromMatrixPosition(y.matrixWorld),C.direction.transformDirection(g),m++}}}return{setup:a,setupView:l,state:n}}function gg(i){let e=new bb(i),t=[],n=[],s=[];function r(d){h.camera=d,t.length=0,n.length=0,s.length=0}function o(d){d.isLightProbeGrid?s.push(d):t.push(d)}function a(d){n.push(d)}function l(){e.setup(t),s.sort((d,u)=>d.priority-u.priority||d.id-u.id)}function c(d){e.setupView(t,d)}let h={lightsArray:t,shadowsArray:n,lightProbeGridArray:s,camera:null,lights:e,transmissionRenderTarget:{},textureUnits:0};return{init:r,state:h,setupLights:l,setupLightsView:c,pushLight:o,pushShadow:a}}function wb(i){let e=new WeakMap;function t(s,r=0){let o=e.get(s),a;return o===void 0?(a=new gg(i),e.set(s,[a])):r>=o.length?(a=new gg(i),o.push(a)):a=o[r],a}function n(){e=new WeakMap}return{get:t,dispose:n}}var Eb=`void main() {
	gl_Position = vec4( position, 1.0 );
}`,Tb=`uniform sampler2D shadow_pass;
uniform vec2 resolution;
uniform float radius;
void main() {
	const float samples = float( VSM_SAMPLES );
	float mean = 0.0;
	float squared_mean = 0.0;
	float uvStride = samples <= 1.0 ? 0.0 : 2.0 / ( samples - 1.0 );
	float uvStart = samples <= 1.0 ? 0.0 : - 1.0;
	for ( float i = 0.0; i < samples; i ++ ) {
		float uvOffset = uvStart + i * uvStride;
		#ifdef HORIZONTAL_PASS
			vec2 distribution = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( uvOffset, 0.0 ) * radius ) / resolution ).rg;
			mean += distribution.x;
			squared_mean += distribution.y * distribution.y + distribution.x * distribution.x;
		#else
			float depth = texture2D( shadow_pass, ( gl_FragCoord.xy + vec2( 0.0, uvOffset ) * radius ) / resolution ).r;
			mean += depth;
			squared_mean += depth * depth;
		#endif
	}
	mean = mean / samples;
	squared_mean = squared_mean / samples;
	float std_dev = sqrt( max( 0.0, squared_mean - mean * mean ) );
	gl_FragColor = vec4( mean, std_dev, 0.0, 1.0 );
}`,Ab=[new X(1,0,0),new X(-1,0,0),new X(0,1,0),new X(0,-1,0),new X(0,0,1),new X(0,0,-1)],Rb=[new X(0,-1,0),new X(0,-1,0),new X(0,0,1),new X(0,0,-1),new X(0,-1,0),new X(0,-1,0)],_g=new Ft,Ha=new X,Wd=new X;function Cb(i,e,t){let n=new Fs,s=new De,r=new De,o=new tn,a=new fc,l=new pc,c={},h=t.maxTextureSize,d={[Hs]:Kn,[Kn]:Hs,[ci]:ci},u=new Ji({defines:{VSM_SAMPLES:8},uniforms:{shadow_pass:{value:null},resolution:{value:new De},radius:{value:4}},vertexShader:Eb,fragmentShader:Tb}),f=u.clone();f.defines.HORIZONTAL_PASS=1;let p=new Jt;p.setAttribute("position",new Un(new Float32Array([-1,-1,.5,3,-1,.5,-1,3,.5]),3));let x=new kn(p,u),m=this;this.enabled=!1,this.autoUpdate=!0,this.needsUpdate=!1,this.type=Da;let g=this.type;this.render=function(A,v,E){if(m.enabled===!1||m.autoUpdate===!1&&m.needsUpdate===!1||A.length===0)return;this.type===rm&&(tt("WebGLShadowMap: PCFSoftShadowMap has been removed. Using PCFShadowMap instead."),this.type=Da);let k=i.getRenderTarget(),N=i.getActiveCubeFace(),I=i.getActiveMipmapLevel(),G=i.state;G.setBlending(hr),G.buffers.depth.getReversed()===!0?G.buffers.color.setClear(0,0,0,0):G.buffers.color.setClear(1,1,1,1),G.buffers.depth.setTest(!0),G.setScissorTest(!1);let W=g!==this.type;W&&v.traverse(function(L){L.material&&(Array.isArray(L.material)?L.material.forEach(H=>H.needsUpdate=!0):L.material.needsUpdate=!0)});for(let L=0,H=A.length;L<H;L++){let Y=A[L],z=Y.shadow;if(z===void 0){tt("WebGLShadowMap:",Y,"has no shadow.");continue}if(z.autoUpdate===!1&&z.needsUpdate===!1)continue;s.copy(z.mapSize);let ce=z.getFrameExtents();s.multiply(ce),r.copy(z.mapSize),(s.x>h||s.y>h)&&(s.x>h&&(r.x=Math.floor(h/ce.x),s.x=r.x*ce.x,z.mapSize.x=r.x),s.y>h&&(r.y=Math.floor(h/ce.y),s.y=r.y*ce.y,z.mapSize.y=r.y));let J=i.state.buffers.depth.getReversed();if(z.camera._reversedDepth=J,z.map===null||W===!0){if(z.map!==null&&(z.map.depthTexture!==null&&(z.map.depthTexture.dispose(),z.map.depthTexture=null),z.map.dispose()),this.type===mo){if(Y.isPointLight){tt("WebGLShadowMap: VSM shadow maps are not supported for PointLights. Use PCF or BasicShadowMap instead.");continue}z.map=new oi(s.x,s.y,{format:Gs,type:Ii,minFilter:Zn,magFilter:Zn,generateMipmaps:!1}),z.map.texture.name=Y.name+".shadowMap",z.map.depthTexture=new gs(s.x,s.y,Pi),z.map.depthTexture.name=Y.name+".shadowMapDepth",z.map.depthTexture.format=fs,z.map.depthTexture.compareFunction=null,z.map.depthTexture.minFilter=Pn,z.map.depthTexture.magFilter=Pn}else Y.isPointLight?(z.map=new Va(s.x),z.map.depthTexture=new ga(s.x,Ci)):(z.map=new oi(s.x,s.y),z.map.depthTexture=new gs(s.x,s.y,Ci)),z.map.depthTexture.name=Y.name+".shadowMap",z.map.depthTexture.format=fs,this.type===Da?(z.map.depthTexture.compareFunction=J?Rd:Ad,z.map.depthTexture.minFilter=Zn,z.map.depthTexture.magFilter=Zn):(z.map.depthTexture.compareFunction=null,z.map.depthTexture.minFilter=Pn,z.map.depthTexture.magFilter=Pn);z.camera.updateProjectionMatrix()}z.map.isWebGLCubeRenderTarget!==!0&&(z.map.width!==s.x||z.map.height!==s.y)&&z.map.setSize(s.x,s.y);let j=z.map.isWebGLCubeRenderTarget?6:z.getViewportCount();Y.isPointLight!==!0&&z.updateMatrices(Y,E);let te=(z.camera.layers.mask&4294967294)!==0?z.camera.layers:E.layers;for(let fe=0;fe<j;fe++){let he=z.getCamera(fe);if(Y.isPointLight){let ee=z.camera,ge=z.matrix,ve=Y.distance||ee.far;ve!==ee.far&&(ee.far=ve,ee.updateProjectionMatrix()),Ha.setFromMatrixPosition(Y.matrixWorld),ee.position.copy(Ha),Wd.copy(ee.position),Wd.add(Ab[fe]),ee.up.copy(Rb[fe]),ee.lookAt(Wd),ee.updateMatrixWorld(),ge.makeTranslation(-Ha.x,-Ha.y,-Ha.z),_g.multiplyMatrices(ee.projectionMatrix,ee.matrixWorldInverse),z._frustum.setFromProjectionMatrix(_g,ee.coordinateSystem,ee.reversedDepth)}if(z.map.isWebGLCubeRenderTarget)i.setRenderTarget(z.map,fe),i.clear();else{fe===0&&(i.setRenderTarget(z.map),i.clear());let ee=z.getViewport(fe);o.set(r.x*ee.x,r.y*ee.y,r.x*ee.z,r.y*ee.w),G.viewport(o)}n=z.getFrustum(fe),y(v,E,he,Y,te,this.type)}z.isPointLightShadow!==!0&&this.type===mo&&S(z,E),z.needsUpdate=!1}g=this.type,m.needsUpdate=!1,i.setRenderTarget(k,N,I)};function S(A,v){let E=e.update(x);u.defines.VSM_SAMPLES!==A.blurSamples&&(u.defines.VSM_SAMPLES=A.blurSamples,f.defines.VSM_SAMPLES=A.blurSamples,u.needsUpdate=!0,f.needsUpdate=!0),A.mapPass===null?A.mapPass=new oi(s.x,s.y,{format:Gs,type:Ii}):(A.mapPass.width!==A.map.width||A.mapPass.height!==A.map.height)&&A.mapPass.setSize(A.map.width,A.map.height),u.uniforms.shadow_pass.value=A.map.depthTexture,u.uniforms.resolution.value.set(A.map.width,A.map.height),u.uniforms.radius.value=A.radius,i.setRenderTarget(A.mapPass),i.clear(),i.renderBufferDirect(v,null,E,u,x,null),f.uniforms.shadow_pass.value=A.mapPass.texture,f.uniforms.resolution.value.set(A.map.width,A.map.height),f.uniforms.radius.value=A.radius,i.setRenderTarget(A.map),i.clear(),i.renderBufferDirect(v,null,E,f,x,null)}function T(A,v,E,k){let N=null,I=E.isPointLight===!0?A.customDistanceMaterial:A.customDepthMaterial;if(I!==void 0)N=I;else if(N=E.isPointLight===!0?l:a,i.localClippingEnabled&&v.clipShadows===!0&&Array.isArray(v.clippingPlanes)&&v.clippingPlanes.length!==0||v.displacementMap&&v.displacementScale!==0||v.alphaMap&&v.alphaTest>0||v.map&&v.alphaTest>0||v.alphaToCoverage===!0){let G=N.uuid,W=v.uuid,L=c[G];L===void 0&&(L={},c[G]=L);let H=L[W];H===void 0&&(H=N.clone(),L[W]=H,v.addEventListener("dispose",C)),N=H}if(N.visible=v.visible,N.wireframe=v.wireframe,k===mo?N.side=v.shadowSide!==null?v.shadowSide:v.side:N.side=v.shadowSide!==null?v.shadowSide:d[v.side],N.alphaMap=v.alphaMap,N.alphaTest=v.alphaToCoverage===!0?.5:v.alphaTest,N.map=v.map,N.clipShadows=v.clipShadows,N.clippingPlanes=v.clippingPlanes,N.clipIntersection=v.clipIntersection,N.displacementMap=v.displacementMap,N.displacementScale=v.displacementScale,N.displacementBias=v.displacementBias,N.wireframeLinewidth=v.wireframeLinewidth,N.linewidth=v.linewidth,E.isPointLight===!0&&N.isMeshDistanceMaterial===!0){let G=i.properties.get(N);G.light=E}return N}function y(A,v,E,k,N,I){if(A.visible===!1)return;if(A.layers.test(N)&&(A.isMesh||A.isLine||A.isPoints)&&(A.castShadow||A.receiveShadow&&I===mo)&&(!A.frustumCulled||A.intersectsFrustum(n))){A.modelViewMatrix.multiplyMatrices(E.matrixWorldInverse,A.matrixWorld);let L=e.update(A),H=A.material;if(Array.isArray(H)){let Y=L.groups;for(let z=0,ce=Y.length;z<ce;z++){let J=Y[z],j=H[J.materialIndex];if(j&&j.visible){let te=T(A,j,k,I);A.onBeforeShadow(i,A,v,E,L,te,J),i.renderBufferDirect(E,null,L,te,A,J),A.onAfterShadow(i,A,v,E,L,te,J)}}}else if(H.visible){let Y=T(A,H,k,I);A.onBeforeShadow(i,A,v,E,L,Y,null),i.renderBufferDirect(E,null,L,Y,A,null),A.onAfterShadow(i,A,v,E,L,Y,null)}}let W=A.children;for(let L=0,H=W.length;L<H;L++)y(W[L],v,E,k,N,I)}function C(A){A.target.removeEventListener("dispose",C);for(let E in c){let k=c[E],N=A.target.uuid;N in k&&(k[N].dispose(),delete k[N])}}}function Pb(i,e){function t(){let O=!1,re=new tn,ie=null,Re=new tn(0,0,0,0);return{setMask:function(ye){ie!==ye&&!O&&(i.colorMask(ye,ye,ye,ye),ie=ye)},setLocked:function(ye){O=ye},setClear:function(ye,Ae,Ke,lt,ue){ue===!0&&(ye*=lt,Ae*=lt,Ke*=lt),re.set(ye,Ae,Ke,lt),Re.equals(re)===!1&&(i.clearColor(ye,Ae,Ke,lt),Re.copy(re))},reset:function(){O=!1,ie=null,Re.set(-1,0,0,0)}}}function n(){let O=!1,re=!1,ie=null,Re=null,ye=null;return{setReversed:function(Ae){if(re!==Ae){let Ke=e.get("EXT_clip_control");Ae?Ke.clipControlEXT(Ke.LOWER_LEFT_EXT,Ke.ZERO_TO_ONE_EXT):Ke.clipControlEXT(Ke.LOWER_LEFT_EXT,Ke.NEGATIVE_ONE_TO_ONE_EXT),re=Ae;let lt=ye;ye=null,this.setClear(lt)}},getReversed:function(){return re},setTest:function(Ae){Ae?be(i.DEPTH_TEST):Ge(i.DEPTH_TEST)},setMask:function(Ae){ie!==Ae&&!O&&(i.depthMask(Ae),ie=Ae)},setFunc:function(Ae){if(re&&(Ae=Bm[Ae]),Re!==Ae){switch(Ae){case Gl:i.depthFunc(i.NEVER);break;case Vl:i.depthFunc(i.ALWAYS);break;case Wl:i.depthFunc(i.LESS);break;case eo:i.depthFunc(i.LEQUAL);break;case Xl:i.depthFunc(i.EQUAL);break;case ql:i.depthFunc(i.GEQUAL);break;case Yl:i.depthFunc(i.GREATER);break;case $l:i.depthFunc(i.NOTEQUAL);break;default:i.depthFunc(i.LEQUAL)}Re=Ae}},setLocked:function(Ae){O=Ae},setClear:function(Ae){ye!==Ae&&(ye=Ae,re&&(Ae=1-Ae),i.clearDepth(Ae))},reset:function(){O=!1,ie=null,Re=null,ye=null,re=!1}}}function s(){let O=!1,re=null,ie=null,Re=null,ye=null,Ae=null,Ke=null,lt=null,ue=null;return{setTest:function(qe){O||(qe?be(i.STENCIL_TEST):Ge(i.STENCIL_TEST))},setMask:function(qe){re!==qe&&!O&&(i.stencilMask(qe),re=qe)},setFunc:function(qe,ct,Ne){(ie!==qe||Re!==ct||ye!==Ne)&&(i.stencilFunc(qe,ct,Ne),ie=qe,Re=ct,ye=Ne)},setOp:function(qe,ct,Ne){(Ae!==qe||Ke!==ct||lt!==Ne)&&(i.stencilOp(qe,ct,Ne),Ae=qe,Ke=ct,lt=Ne)},setLocked:function(qe){O=qe},setClear:function(qe){ue!==qe&&(i.clearStencil(qe),ue=qe)},reset:function(){O=!1,re=null,ie=null,Re=null,ye=null,Ae=null,Ke=null,lt=null,ue=null}}}let r=new t,o=new n,a=new s,l={},c=new WeakMap,h={},d={},u={},f=new WeakMap,p=[],x=null,m=!1,g=null,S=null,T=null,y=null,C=null,A=null,v=null,E=new pt(0,0,0),k=0,N=!1,I=null,G=null,W=null,L=null,H=null,Y=i.getParameter(i.MAX_COMBINED_TEXTURE_IMAGE_UNITS),z=!1,ce=0,J=i.getParameter(i.VERSION);J.indexOf("WebGL")!==-1?(ce=parseFloat(/^WebGL (\d)/.exec(J)[1]),z=ce>=1):J.indexOf("OpenGL ES")!==-1&&(ce=parseFloat(/^OpenGL ES (\d)/.exec(J)[1]),z=ce>=2);let j=null,te={},fe=i.getParameter(i.SCISSOR_BOX),he=i.getParameter(i.VIEWPORT),ee=new tn().fromArray(fe),ge=new tn().fromArray(he);function ve(O,re,ie,Re){let ye=new Uint8Array(4),Ae=i.createTexture();i.bindTexture(O,Ae),i.texParameteri(O,i.TEXTURE_MIN_FILTER,i.NEAREST),i.texParameteri(O,i.TEXTURE_MAG_FILTER,i.NEAREST);for(let Ke=0;Ke<ie;Ke++)O===i.TEXTURE_3D||O===i.TEXTURE_2D_ARRAY?i.texImage3D(re,0,i.RGBA,1,1,Re,0,i.RGBA,i.UNSIGNED_BYTE,ye):i.texImage2D(re+Ke,0,i.RGBA,1,1,0,i.RGBA,i.UNSIGNED_BYTE,ye);return Ae}let Ie={};Ie[i.TEXTURE_2D]=ve(i.TEXTURE_2D,i.TEXTURE_2D,1),Ie[i.TEXTURE_CUBE_MAP]=ve(i.TEXTURE_CUBE_MAP,i.TEXTURE_CUBE_MAP_POSITIVE_X,6),Ie[i.TEXTURE_2D_ARRAY]=ve(i.TEXTURE_2D_ARRAY,i.TEXTURE_2D_ARRAY,1,1),Ie[i.TEXTURE_3D]=ve(i.TEXTURE_3D,i.TEXTURE_3D,1,1),r.setClear(0,0,0,1),o.setClear(1),a.setClear(0),be(i.DEPTH_TEST),o.setFunc(eo),Be(!1),Le(od),be(i.CULL_FACE),xe(hr);function be(O){h[O]!==!0&&(i.enable(O),h[O]=!0)}function Ge(O){h[O]!==!1&&(i.disable(O),h[O]=!1)}function st(O,re){return u[O]!==re?(i.bindFramebuffer(O,re),u[O]=re,O===i.DRAW_FRAMEBUFFER&&(u[i.FRAMEBUFFER]=re),O===i.FRAMEBUFFER&&(u[i.DRAW_FRAMEBUFFER]=re),!0):!1}function Je(O,re){let ie=p,Re=!1;if(O){ie=f.get(re),ie===void 0&&(ie=[],f.set(re,ie));let ye=O.textures;if(ie.length!==ye.length||ie[0]!==i.COLOR_ATTACHMENT0){for(let Ae=0,Ke=ye.length;Ae<Ke;Ae++)ie[Ae]=i.COLOR_ATTACHMENT0+Ae;ie.length=ye.length,Re=!0}}else ie[0]!==i.BACK&&(ie[0]=i.BACK,Re=!0);Re&&i.drawBuffers(ie)}function rt(O){return x!==O?(i.useProgram(O),x=O,!0):!1}let it={[ur]:i.FUNC_ADD,[am]:i.FUNC_SUBTRACT,[lm]:i.FUNC_REVERSE_SUBTRACT};it[cm]=i.MIN,it[hm]=i.MAX;let oe={[um]:i.ZERO,[dm]:i.ONE,[fm]:i.SRC_COLOR,[hd]:i.SRC_ALPHA,[xm]:i.SRC_ALPHA_SATURATE,[_m]:i.DST_COLOR,[mm]:i.DST_ALPHA,[pm]:i.ONE_MINUS_SRC_COLOR,[ud]:i.ONE_MINUS_SRC_ALPHA,[vm]:i.ONE_MINUS_DST_COLOR,[gm]:i.ONE_MINUS_DST_ALPHA,[ym]:i.CONSTANT_COLOR,[Sm]:i.ONE_MINUS_CONSTANT_COLOR,[Mm]:i.CONSTANT_ALPHA,[bm]:i.ONE_MINUS_CONSTANT_ALPHA};function xe(O,re,ie,Re,ye,Ae,Ke,lt,ue,qe){if(O===hr){m===!0&&(Ge(i.BLEND),m=!1);return}if(m===!1&&(be(i.BLEND),m=!0),O!==om){if(O!==g||qe!==N){if((S!==ur||C!==ur)&&(i.blendEquation(i.FUNC_ADD),S=ur,C=ur),qe)switch(O){case go:i.blendFuncSeparate(i.ONE,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case ad:i.blendFunc(i.ONE,i.ONE);break;case ld:i.blendFuncSeparate(i.ZERO,i.ONE_MINUS_SRC_COLOR,i.ZERO,i.ONE);break;case cd:i.blendFuncSeparate(i.DST_COLOR,i.ONE_MINUS_SRC_ALPHA,i.ZERO,i.ONE);break;default:at("WebGLState: Invalid blending: ",O);break}else switch(O){case go:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE_MINUS_SRC_ALPHA,i.ONE,i.ONE_MINUS_SRC_ALPHA);break;case ad:i.blendFuncSeparate(i.SRC_ALPHA,i.ONE,i.ONE,i.ONE);break;case ld:at("WebGLState: SubtractiveBlending requires material.premultipliedAlpha = true");break;case cd:at("WebGLState: MultiplyBlending requires material.premultipliedAlpha = true");break;default:at("WebGLState: Invalid blending: ",O);break}T=null,y=null,A=null,v=null,E.set(0,0,0),k=0,g=O,N=qe}return}ye=ye||re,Ae=Ae||ie,Ke=Ke||Re,(re!==S||ye!==C)&&(i.blendEquationSeparate(it[re],it[ye]),S=re,C=ye),(ie!==T||Re!==y||Ae!==A||Ke!==v)&&(i.blendFuncSeparate(oe[ie],oe[Re],oe[Ae],oe[Ke]),T=ie,y=Re,A=Ae,v=Ke),(lt.equals(E)===!1||ue!==k)&&(i.blendColor(lt.r,lt.g,lt.b,ue),E.copy(lt),k=ue),g=O,N=!1}function _e(O,re){O.side===ci?Ge(i.CULL_FACE):be(i.CULL_FACE);let ie=O.side===Kn;re&&(ie=!ie),Be(ie),O.blending===go&&O.transparent===!1?xe(hr):xe(O.blending,O.blendEquation,O.blendSrc,O.blendDst,O.blendEquationAlpha,O.blendSrcAlpha,O.blendDstAlpha,O.blendColor,O.blendAlpha,O.premultipliedAlpha),o.setFunc(O.depthFunc),o.setTest(O.depthTest),o.setMask(O.depthWrite),r.setMask(O.colorWrite);let Re=O.stencilWrite;a.setTest(Re),Re&&(a.setMask(O.stencilWriteMask),a.setFunc(O.stencilFunc,O.stencilRef,O.stencilFuncMask),a.setOp(O.stencilFail,O.stencilZFail,O.stencilZPass)),ke(O.polygonOffset,O.polygonOffsetFactor,O.polygonOffsetUnits),O.alphaToCoverage===!0?be(i.SAMPLE_ALPHA_TO_COVERAGE):Ge(i.SAMPLE_ALPHA_TO_COVERAGE)}function Be(O){I!==O&&(O?i.frontFace(i.CW):i.frontFace(i.CCW),I=O)}function Le(O){O!==im?(be(i.CULL_FACE),O!==G&&(O===od?i.cullFace(i.BACK):O===sm?i.cullFace(i.FRONT):i.cullFace(i.FRONT_AND_BACK))):Ge(i.CULL_FACE),G=O}function nt(O){O!==W&&(z&&i.lineWidth(O),W=O)}function ke(O,re,ie){O?(be(i.POLYGON_OFFSET_FILL),(L!==re||H!==ie)&&(L=re,H=ie,o.getReversed()&&(re=-re,ie=-ie),i.polygonOffset(re,ie))):Ge(i.POLYGON_OFFSET_FILL)}function gt(O){O?be(i.SCISSOR_TEST):Ge(i.SCISSOR_TEST)}function dt(O){O===void 0&&(O=i.TEXTURE0+Y-1),j!==O&&(i.activeTexture(O),j=O)}function vt(O,re,ie){ie===void 0&&(j===null?ie=i.TEXTURE0+Y-1:ie=j);let Re=te[ie];Re===void 0&&(Re={type:void 0,texture:void 0},te[ie]=Re),(Re.type!==O||Re.texture!==re)&&(j!==ie&&(i.activeTexture(ie),j=ie),i.bindTexture(O,re||Ie[O]),Re.type=O,Re.texture=re)}function U(){let O=te[j];O!==void 0&&O.type!==void 0&&(i.bindTexture(O.type,null),O.type=void 0,O.texture=void 0)}function Se(){try{i.compressedTexImage2D(...arguments)}catch(O){at("WebGLState:",O)}}function Xe(){try{i.compressedTexImage3D(...arguments)}catch(O){at("WebGLState:",O)}}function ht(){try{i.texSubImage2D(...arguments)}catch(O){at("WebGLState:",O)}}function we(){try{i.texSubImage3D(...arguments)}catch(O){at("WebGLState:",O)}}function Nt(){try{i.compressedTexSubImage2D(...arguments)}catch(O){at("WebGLState:",O)}}function $e(){try{i.compressedTexSubImage3D(...arguments)}catch(O){at("WebGLState:",O)}}function je(){try{i.texStorage2D(...arguments)}catch(O){at("WebGLState:",O)}}function R(){try{i.texStorage3D(...arguments)}catch(O){at("WebGLState:",O)}}function M(){try{i.texImage2D(...arguments)}catch(O){at("WebGLState:",O)}}function q(){try{i.texImage3D(...arguments)}catch(O){at("WebGLState:",O)}}function de(O){return d[O]!==void 0?d[O]:i.getParameter(O)}function ae(O,re){d[O]!==re&&(i.pixelStorei(O,re),d[O]=re)}function Me(O){ee.equals(O)===!1&&(i.scissor(O.x,O.y,O.z,O.w),ee.copy(O))}function Ee(O){ge.equals(O)===!1&&(i.viewport(O.x,O.y,O.z,O.w),ge.copy(O))}function ne(O,re){let ie=c.get(re);ie===void 0&&(ie=new WeakMap,c.set(re,ie));let Re=ie.get(O);Re===void 0&&(Re=i.getUniformBlockIndex(re,O.name),i.uniformBlockBinding(re,Re,Re),ie.set(O,Re))}function se(O,re,ie){let ye=c.get(re).get(O);l[ye]!==ie&&(i.bindBufferBase(i.UNIFORM_BUFFER,ye,ie),l[ye]=ie)}function me(){i.disable(i.BLEND),i.disable(i.CULL_FACE),i.disable(i.DEPTH_TEST),i.disable(i.POLYGON_OFFSET_FILL),i.disable(i.SCISSOR_TEST),i.disable(i.STENCIL_TEST),i.disable(i.SAMPLE_ALPHA_TO_COVERAGE),i.blendEquation(i.FUNC_ADD),i.blendFunc(i.ONE,i.ZERO),i.blendFuncSeparate(i.ONE,i.ZERO,i.ONE,i.ZERO),i.blendColor(0,0,0,0),i.colorMask(!0,!0,!0,!0),i.clearColor(0,0,0,0),i.depthMask(!0),i.depthFunc(i.LESS),o.setReversed(!1),i.clearDepth(1),i.stencilMask(4294967295),i.stencilFunc(i.ALWAYS,0,4294967295),i.stencilOp(i.KEEP,i.KEEP,i.KEEP),i.clearStencil(0),i.cullFace(i.BACK),i.frontFace(i.CCW),i.polygonOffset(0,0),i.activeTexture(i.TEXTURE0),i.bindFramebuffer(i.FRAMEBUFFER,null),i.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),i.bindFramebuffer(i.READ_FRAMEBUFFER,null),i.useProgram(null),i.lineWidth(1),i.scissor(0,0,i.canvas.width,i.canvas.height),i.viewport(0,0,i.canvas.width,i.canvas.height),i.pixelStorei(i.PACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_ALIGNMENT,4),i.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,!1),i.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,!1),i.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,i.BROWSER_DEFAULT_WEBGL),i.pixelStorei(i.PACK_ROW_LENGTH,0),i.pixelStorei(i.PACK_SKIP_PIXELS,0),i.pixelStorei(i.PACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_ROW_LENGTH,0),i.pixelStorei(i.UNPACK_IMAGE_HEIGHT,0),i.pixelStorei(i.UNPACK_SKIP_PIXELS,0),i.pixelStorei(i.UNPACK_SKIP_ROWS,0),i.pixelStorei(i.UNPACK_SKIP_IMAGES,0),h={},d={},j=null,te={},u={},l={},f=new WeakMap,p=[],x=null,m=!1,g=null,S=null,T=null,y=null,C=null,A=null,v=null,E=new pt(0,0,0),k=0,N=!1,I=null,G=null,W=null,L=null,H=null,ee.set(0,0,i.canvas.width,i.canvas.height),ge.set(0,0,i.canvas.width,i.canvas.height),r.reset(),o.reset(),a.reset()}return{buffers:{color:r,depth:o,stencil:a},enable:be,disable:Ge,bindFramebuffer:st,drawBuffers:Je,useProgram:rt,setBlending:xe,setMaterial:_e,setFlipSided:Be,setCullFace:Le,setLineWidth:nt,setPolygonOffset:ke,setScissorTest:gt,activeTexture:dt,bindTexture:vt,unbindTexture:U,compressedTexImage2D:Se,compressedTexImage3D:Xe,texImage2D:M,texImage3D:q,pixelStorei:ae,getParameter:de,updateUBOMapping:ne,uniformBlockBinding:se,texStorage2D:je,texStorage3D:R,texSubImage2D:ht,texSubImage3D:we,compressedTexSubImage2D:Nt,compressedTexSubImage3D:$e,scissor:Me,viewport:Ee,reset:me}}function Ib(i,e,t,n,s,r,o){let a=e.has("WEBGL_multisampled_render_to_texture")?e.get("WEBGL_multisampled_render_to_texture"):null,l=typeof navigator>"u"?!1:/OculusBrowser/g.test(navigator.userAgent),c=new De,h=new WeakMap,d=new Set,u,f=new WeakMap,p=new Set,x=new FinalizationRegistry(R=>p.delete(R)),m=!1;try{m=typeof OffscreenCanvas<"u"&&new OffscreenCanvas(1,1).getContext("2d")!==null}catch{}function g(R,M){return m?new OffscreenCanvas(R,M):ra("canvas")}function S(R,M,q){let de=1,ae=je(R);if((ae.width>q||ae.height>q)&&(de=q/Math.max(ae.width,ae.height)),de<1)if(typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement||typeof HTMLCanvasElement<"u"&&R instanceof HTMLCanvasElement||typeof ImageBitmap<"u"&&R instanceof ImageBitmap||typeof VideoFrame<"u"&&R instanceof VideoFrame){let Me=Math.floor(de*ae.width),Ee=Math.floor(de*ae.height);u===void 0&&(u=g(Me,Ee));let ne=M?g(Me,Ee):u;return ne.width=Me,ne.height=Ee,ne.getContext("2d").drawImage(R,0,0,Me,Ee),tt("WebGLRenderer: Texture has been resized from ("+ae.width+"x"+ae.height+") to ("+Me+"x"+Ee+")."),ne}else return"data"in R&&tt("WebGLRenderer: Image in DataTexture is too big ("+ae.width+"x"+ae.height+")."),R;return R}function T(R){return R.generateMipmaps}function y(R){i.generateMipmap(R)}function C(R){return R.isWebGLCubeRenderTarget?i.TEXTURE_CUBE_MAP:R.isWebGL3DRenderTarget?i.TEXTURE_3D:R.isWebGLArrayRenderTarget||R.isCompressedArrayTexture?i.TEXTURE_2D_ARRAY:i.TEXTURE_2D}function A(R,M,q,de,ae,Me=!1){if(R!==null){if(i[R]!==void 0)return i[R];tt("WebGLRenderer: Attempt to use non-existing WebGL internal format '"+R+"'")}let Ee;de&&(Ee=e.get("EXT_texture_norm16"),Ee||tt("WebGLRenderer: Unable to use normalized textures without EXT_texture_norm16 extension"));let ne=M;if(M===i.RED&&(q===i.FLOAT&&(ne=i.R32F),q===i.HALF_FLOAT&&(ne=i.R16F),q===i.UNSIGNED_BYTE&&(ne=i.R8),q===i.UNSIGNED_SHORT&&Ee&&(ne=Ee.R16_EXT),q===i.SHORT&&Ee&&(ne=Ee.R16_SNORM_EXT)),M===i.RED_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.R8UI),q===i.UNSIGNED_SHORT&&(ne=i.R16UI),q===i.UNSIGNED_INT&&(ne=i.R32UI),q===i.BYTE&&(ne=i.R8I),q===i.SHORT&&(ne=i.R16I),q===i.INT&&(ne=i.R32I)),M===i.RG&&(q===i.FLOAT&&(ne=i.RG32F),q===i.HALF_FLOAT&&(ne=i.RG16F),q===i.UNSIGNED_BYTE&&(ne=i.RG8),q===i.UNSIGNED_SHORT&&Ee&&(ne=Ee.RG16_EXT),q===i.SHORT&&Ee&&(ne=Ee.RG16_SNORM_EXT)),M===i.RG_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.RG8UI),q===i.UNSIGNED_SHORT&&(ne=i.RG16UI),q===i.UNSIGNED_INT&&(ne=i.RG32UI),q===i.BYTE&&(ne=i.RG8I),q===i.SHORT&&(ne=i.RG16I),q===i.INT&&(ne=i.RG32I)),M===i.RGB_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.RGB8UI),q===i.UNSIGNED_SHORT&&(ne=i.RGB16UI),q===i.UNSIGNED_INT&&(ne=i.RGB32UI),q===i.BYTE&&(ne=i.RGB8I),q===i.SHORT&&(ne=i.RGB16I),q===i.INT&&(ne=i.RGB32I)),M===i.RGBA_INTEGER&&(q===i.UNSIGNED_BYTE&&(ne=i.RGBA8UI),q===i.UNSIGNED_SHORT&&(ne=i.RGBA16UI),q===i.UNSIGNED_INT&&(ne=i.RGBA32UI),q===i.BYTE&&(ne=i.RGBA8I),q===i.SHORT&&(ne=i.RGBA16I),q===i.INT&&(ne=i.RGBA32I)),M===i.RGB&&(q===i.UNSIGNED_SHORT&&Ee&&(ne=Ee.RGB16_EXT),q===i.SHORT&&Ee&&(ne=Ee.RGB16_SNORM_EXT),q===i.UNSIGNED_INT_5_9_9_9_REV&&(ne=i.RGB9_E5),q===i.UNSIGNED_INT_10F_11F_11F_REV&&(ne=i.R11F_G11F_B10F)),M===i.RGBA){let se=Me?sa:Tt.getTransfer(ae);q===i.FLOAT&&(ne=i.RGBA32F),q===i.HALF_FLOAT&&(ne=i.RGBA16F),q===i.UNSIGNED_BYTE&&(ne=se===Ut?i.SRGB8_ALPHA8:i.RGBA8),q===i.UNSIGNED_SHORT&&Ee&&(ne=Ee.RGBA16_EXT),q===i.SHORT&&Ee&&(ne=Ee.RGBA16_SNORM_EXT),q===i.UNSIGNED_SHORT_4_4_4_4&&(ne=i.RGBA4),q===i.UNSIGNED_SHORT_5_5_5_1&&(ne=i.RGB5_A1)}return(ne===i.R16F||ne===i.R32F||ne===i.RG16F||ne===i.RG32F||ne===i.RGBA16F||ne===i.RGBA32F)&&e.get("EXT_color_buffer_float"),ne}function v(R,M){let q;return R?M===null||M===Ci||M===fr?q=i.DEPTH24_STENCIL8:M===Pi?q=i.DEPTH32F_STENCIL8:M===vo&&(q=i.DEPTH24_STENCIL8,tt("DepthTexture: 16 bit depth attachment is not supported with stencil. Using 24-bit attachment.")):M===null||M===Ci||M===fr?q=i.DEPTH_COMPONENT24:M===Pi?q=i.DEPTH_COMPONENT32F:M===vo&&(q=i.DEPTH_COMPONENT16),q}function E(R,M){return T(R)===!0||R.isFramebufferTexture&&R.minFilter!==Pn&&R.minFilter!==Zn?Math.log2(Math.max(M.width,M.height))+1:R.mipmaps.length>0?R.mipmaps.length:R.isCompressedTexture&&Array.isArray(R.image)?M.mipmaps.length:1}function k(R){let M=new WeakRef(R);n.get(R).__ref=M,p.add(M),x.register(R,M,M)}function N(R){let M=n.get(R).__ref;M!==void 0&&(p.delete(M),x.unregister(M))}function I(R){W(R.target)}function G(R){L(R.target)}function W(R){R.removeEventListener("dispose",I),N(R),Y(R),R.isVideoTexture&&h.delete(R),R.isHTMLTexture&&d.delete(R)}function L(R){R.removeEventListener("dispose",G),N(R),ce(R)}function H(){for(let R of p){let M=R.deref();M!==void 0&&(M.isRenderTarget===!0?L(M):W(M))}p.clear(),d.clear()}function Y(R){let M=n.get(R);if(M.__webglInit===void 0)return;let q=R.source,de=f.get(q);if(de){let ae=de[M.__cacheKey];ae.usedTimes--,ae.usedTimes===0&&z(R),Object.keys(de).length===0&&f.delete(q)}n.remove(R)}function z(R){let M=n.get(R);i.deleteTexture(M.__webglTexture);let q=R.source,de=f.get(q);delete de[M.__cacheKey],o.memory.textures--}function ce(R){let M=n.get(R);M.__depthDisposeCallback&&M.__depthDisposeCallback();let q=R.depthTexture;if(q&&q.renderTarget===R&&W(q),R.isWebGLCubeRenderTarget)for(let ae=0;ae<6;ae++){if(Array.isArray(M.__webglFramebuffer[ae]))for(let Me=0;Me<M.__webglFramebuffer[ae].length;Me++)i.deleteFramebuffer(M.__webglFramebuffer[ae][Me]);else i.deleteFramebuffer(M.__webglFramebuffer[ae]);M.__webglDepthbuffer&&i.deleteRenderbuffer(M.__webglDepthbuffer[ae])}else{if(Array.isArray(M.__webglFramebuffer))for(let ae=0;ae<M.__webglFramebuffer.length;ae++)i.deleteFramebuffer(M.__webglFramebuffer[ae]);else i.deleteFramebuffer(M.__webglFramebuffer);if(M.__webglDepthbuffer&&i.deleteRenderbuffer(M.__webglDepthbuffer),M.__webglMultisampledFramebuffer&&i.deleteFramebuffer(M.__webglMultisampledFramebuffer),M.__webglColorRenderbuffer)for(let ae=0;ae<M.__webglColorRenderbuffer.length;ae++)M.__webglColorRenderbuffer[ae]&&i.deleteRenderbuffer(M.__webglColorRenderbuffer[ae]);M.__webglDepthRenderbuffer&&i.deleteRenderbuffer(M.__webglDepthRenderbuffer)}let de=R.textures;for(let ae=0,Me=de.length;ae<Me;ae++){let Ee=n.get(de[ae]);Ee.__webglTexture&&(i.deleteTexture(Ee.__webglTexture),o.memory.textures--),n.remove(de[ae])}n.remove(R)}let J=0;function j(){J=0}function te(){return J}function fe(R){J=R}function he(){let R=J;return R>=s.maxTextures&&tt("WebGLTextures: Trying to use "+(R+1)+" texture units while this GPU supports only "+s.maxTextures),J+=1,R}function ee(R){let M=[];return M.push(R.wrapS),M.push(R.wrapT),M.push(R.wrapR||0),M.push(R.magFilter),M.push(R.minFilter),M.push(R.anisotropy),M.push(R.internalFormat),M.push(R.format),M.push(R.type),M.push(R.generateMipmaps),M.push(R.mipmapsAutoUpdate),M.push(R.premultiplyAlpha),M.push(R.flipY),M.push(R.unpackAlignment),M.push(R.colorSpace),M.join()}function ge(R,M){let q=n.get(R);if(R.isVideoTexture&&Nt(R),R.isRenderTargetTexture===!1&&R.isExternalTexture!==!0&&R.version>0&&q.__version!==R.version){let de=R.image;if(de===null)tt("WebGLRenderer: Texture marked for update but no image data found.");else if(de.complete===!1)tt("WebGLRenderer: Texture marked for update but image is incomplete");else{_e(q,R,M);return}}else R.isExternalTexture&&(q.__webglTexture=R.sourceTexture?R.sourceTexture:null);t.bindTexture(i.TEXTURE_2D,q.__webglTexture,i.TEXTURE0+M)}function ve(R,M){let q=n.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&q.__version!==R.version){_e(q,R,M);return}else R.isExternalTexture&&(q.__webglTexture=R.sourceTexture?R.sourceTexture:null);t.bindTexture(i.TEXTURE_2D_ARRAY,q.__webglTexture,i.TEXTURE0+M)}function Ie(R,M){let q=n.get(R);if(R.isRenderTargetTexture===!1&&R.version>0&&q.__version!==R.version){_e(q,R,M);return}t.bindTexture(i.TEXTURE_3D,q.__webglTexture,i.TEXTURE0+M)}function be(R,M){let q=n.get(R);if(R.version>0&&q.__version!==R.version){Be(q,R,M);return}t.bindTexture(i.TEXTURE_CUBE_MAP,q.__webglTexture,i.TEXTURE0+M)}let Ge={[Zl]:i.REPEAT,[qi]:i.CLAMP_TO_EDGE,[Jl]:i.MIRRORED_REPEAT},st={[Pn]:i.NEAREST,[Tm]:i.NEAREST_MIPMAP_NEAREST,[Na]:i.NEAREST_MIPMAP_LINEAR,[Zn]:i.LINEAR,[Ic]:i.LINEAR_MIPMAP_NEAREST,[_s]:i.LINEAR_MIPMAP_LINEAR},Je={[Pm]:i.NEVER,[Cd]:i.ALWAYS,[Im]:i.LESS,[Ad]:i.LEQUAL,[Lm]:i.EQUAL,[Rd]:i.GEQUAL,[Dm]:i.GREATER,[Nm]:i.NOTEQUAL};function rt(R,M){if(M.type===Pi&&e.has("OES_texture_float_linear")===!1&&(M.magFilter===Zn||M.magFilter===Ic||M.magFilter===Na||M.magFilter===_s||M.minFilter===Zn||M.minFilter===Ic||M.minFilter===Na||M.minFilter===_s)&&tt("WebGLRenderer: Unable to use linear filtering with floating point textures. OES_texture_float_linear not supported on this device."),i.texParameteri(R,i.TEXTURE_WRAP_S,Ge[M.wrapS]),i.texParameteri(R,i.TEXTURE_WRAP_T,Ge[M.wrapT]),(R===i.TEXTURE_3D||R===i.TEXTURE_2D_ARRAY)&&i.texParameteri(R,i.TEXTURE_WRAP_R,Ge[M.wrapR]),i.texParameteri(R,i.TEXTURE_MAG_FILTER,st[M.magFilter]),i.texParameteri(R,i.TEXTURE_MIN_FILTER,st[M.minFilter]),M.compareFunction&&(i.texParameteri(R,i.TEXTURE_COMPARE_MODE,i.COMPARE_REF_TO_TEXTURE),i.texParameteri(R,i.TEXTURE_COMPARE_FUNC,Je[M.compareFunction])),e.has("EXT_texture_filter_anisotropic")===!0){if(M.magFilter===Pn||M.minFilter!==Na&&M.minFilter!==_s||M.type===Pi&&e.has("OES_texture_float_linear")===!1)return;if(M.anisotropy>1||n.get(M).__currentAnisotropy){let q=e.get("EXT_texture_filter_anisotropic");i.texParameterf(R,q.TEXTURE_MAX_ANISOTROPY_EXT,Math.min(M.anisotropy,s.getMaxAnisotropy())),n.get(M).__currentAnisotropy=M.anisotropy}}}function it(R,M){let q=!1;R.__webglInit===void 0&&(R.__webglInit=!0,M.addEventListener("dispose",I),k(M));let de=M.source,ae=f.get(de);ae===void 0&&(ae={},f.set(de,ae));let Me=ee(M);if(Me!==R.__cacheKey){ae[Me]===void 0&&(ae[Me]={texture:i.createTexture(),usedTimes:0},o.memory.textures++,q=!0),ae[Me].usedTimes++;let Ee=ae[R.__cacheKey];Ee!==void 0&&(ae[R.__cacheKey].usedTimes--,Ee.usedTimes===0&&z(M)),R.__cacheKey=Me,R.__webglTexture=ae[Me].texture}return q}function oe(R,M,q){return Math.floor(Math.floor(R/q)/M)}function xe(R,M,q,de){let Me=R.updateRanges;if(Me.length===0)t.texSubImage2D(i.TEXTURE_2D,0,0,0,M.width,M.height,q,de,M.data);else{Me.sort((O,re)=>O.start-re.start);let Ee=0;for(let O=1;O<Me.length;O++){let re=Me[Ee],ie=Me[O],Re=re.start+re.count,ye=oe(ie.start,M.width,4),Ae=oe(re.start,M.width,4);ie.start<=Re+1&&ye===Ae&&oe(ie.start+ie.count-1,M.width,4)===ye?re.count=Math.max(re.count,ie.start+ie.count-re.start):(++Ee,Me[Ee]=ie)}Me.length=Ee+1;let ne=t.getParameter(i.UNPACK_ROW_LENGTH),se=t.getParameter(i.UNPACK_SKIP_PIXELS),me=t.getParameter(i.UNPACK_SKIP_ROWS);t.pixelStorei(i.UNPACK_ROW_LENGTH,M.width);for(let O=0,re=Me.length;O<re;O++){let ie=Me[O],Re=Math.floor(ie.start/4),ye=Math.ceil(ie.count/4),Ae=Re%M.width,Ke=Math.floor(Re/M.width),lt=ye,ue=1;t.pixelStorei(i.UNPACK_SKIP_PIXELS,Ae),t.pixelStorei(i.UNPACK_SKIP_ROWS,Ke),t.texSubImage2D(i.TEXTURE_2D,0,Ae,Ke,lt,ue,q,de,M.data)}R.clearUpdateRanges(),t.pixelStorei(i.UNPACK_ROW_LENGTH,ne),t.pixelStorei(i.UNPACK_SKIP_PIXELS,se),t.pixelStorei(i.UNPACK_SKIP_ROWS,me)}}function _e(R,M,q){let de=i.TEXTURE_2D;(M.isDataArrayTexture||M.isCompressedArrayTexture)&&(de=i.TEXTURE_2D_ARRAY),M.isData3DTexture&&(de=i.TEXTURE_3D);let ae=it(R,M),Me=M.source;t.bindTexture(de,R.__webglTexture,i.TEXTURE0+q);let Ee=n.get(Me);if(Me.version!==Ee.__version||ae===!0){if(t.activeTexture(i.TEXTURE0+q),(typeof ImageBitmap<"u"&&M.image instanceof ImageBitmap)===!1){let ue=Tt.getPrimaries(Tt.workingColorSpace),qe=M.colorSpace===xs?null:Tt.getPrimaries(M.colorSpace),ct=M.colorSpace===xs||ue===qe?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,M.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,ct)}t.pixelStorei(i.UNPACK_ALIGNMENT,M.unpackAlignment);let se=S(M.image,!1,s.maxTextureSize);se=$e(M,se);let me=r.convert(M.format,M.colorSpace),O=r.convert(M.type),re=A(M.internalFormat,me,O,M.normalized,M.colorSpace,M.isVideoTexture);rt(de,M);let ie,Re=M.mipmaps,ye=M.isVideoTexture!==!0,Ae=Ee.__version===void 0||ae===!0,Ke=Me.dataReady,lt=E(M,se);if(M.isDepthTexture)re=v(M.format===vs,M.type),Ae&&(ye?t.texStorage2D(i.TEXTURE_2D,1,re,se.width,se.height):t.texImage2D(i.TEXTURE_2D,0,re,se.width,se.height,0,me,O,null));else if(M.isDataTexture)if(Re.length>0){ye&&Ae&&t.texStorage2D(i.TEXTURE_2D,lt,re,Re[0].width,Re[0].height);for(let ue=0,qe=Re.length;ue<qe;ue++)ie=Re[ue],ye?Ke&&t.texSubImage2D(i.TEXTURE_2D,ue,0,0,ie.width,ie.height,me,O,ie.data):t.texImage2D(i.TEXTURE_2D,ue,re,ie.width,ie.height,0,me,O,ie.data);M.generateMipmaps=!1}else ye?(Ae&&t.texStorage2D(i.TEXTURE_2D,lt,re,se.width,se.height),Ke&&xe(M,se,me,O)):t.texImage2D(i.TEXTURE_2D,0,re,se.width,se.height,0,me,O,se.data);else if(M.isCompressedTexture)if(M.isCompressedArrayTexture){ye&&Ae&&t.texStorage3D(i.TEXTURE_2D_ARRAY,lt,re,Re[0].width,Re[0].height,se.depth);for(let ue=0,qe=Re.length;ue<qe;ue++)if(ie=Re[ue],M.format!==Li)if(me!==null)if(ye){if(Ke)if(M.layerUpdates.size>0){let ct=Od(ie.width,ie.height,M.format,M.type);for(let Ne of M.layerUpdates){let _t=ie.data.subarray(Ne*ct/ie.data.BYTES_PER_ELEMENT,(Ne+1)*ct/ie.data.BYTES_PER_ELEMENT);t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ue,0,0,Ne,ie.width,ie.height,1,me,_t)}}else t.compressedTexSubImage3D(i.TEXTURE_2D_ARRAY,ue,0,0,0,ie.width,ie.height,se.depth,me,ie.data)}else t.compressedTexImage3D(i.TEXTURE_2D_ARRAY,ue,re,ie.width,ie.height,se.depth,0,ie.data,0,0);else tt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()");else ye?Ke&&t.texSubImage3D(i.TEXTURE_2D_ARRAY,ue,0,0,0,ie.width,ie.height,se.depth,me,O,ie.data):t.texImage3D(i.TEXTURE_2D_ARRAY,ue,re,ie.width,ie.height,se.depth,0,me,O,ie.data);M.layerUpdates.size>0&&M.clearLayerUpdates()}else{ye&&Ae&&t.texStorage2D(i.TEXTURE_2D,lt,re,Re[0].width,Re[0].height);for(let ue=0,qe=Re.length;ue<qe;ue++)ie=Re[ue],M.format!==Li?me!==null?ye?Ke&&t.compressedTexSubImage2D(i.TEXTURE_2D,ue,0,0,ie.width,ie.height,me,ie.data):t.compressedTexImage2D(i.TEXTURE_2D,ue,re,ie.width,ie.height,0,ie.data):tt("WebGLRenderer: Attempt to load unsupported compressed texture format in .uploadTexture()"):ye?Ke&&t.texSubImage2D(i.TEXTURE_2D,ue,0,0,ie.width,ie.height,me,O,ie.data):t.texImage2D(i.TEXTURE_2D,ue,re,ie.width,ie.height,0,me,O,ie.data)}else if(M.isDataArrayTexture)if(ye){if(Ae&&t.texStorage3D(i.TEXTURE_2D_ARRAY,lt,re,se.width,se.height,se.depth),Ke)if(M.layerUpdates.size>0){let ue=Od(se.width,se.height,M.format,M.type);for(let qe of M.layerUpdates){let ct=se.data.subarray(qe*ue/se.data.BYTES_PER_ELEMENT,(qe+1)*ue/se.data.BYTES_PER_ELEMENT);t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,qe,se.width,se.height,1,me,O,ct)}M.clearLayerUpdates()}else t.texSubImage3D(i.TEXTURE_2D_ARRAY,0,0,0,0,se.width,se.height,se.depth,me,O,se.data)}else t.texImage3D(i.TEXTURE_2D_ARRAY,0,re,se.width,se.height,se.depth,0,me,O,se.data);else if(M.isData3DTexture)ye?(Ae&&t.texStorage3D(i.TEXTURE_3D,lt,re,se.width,se.height,se.depth),Ke&&t.texSubImage3D(i.TEXTURE_3D,0,0,0,0,se.width,se.height,se.depth,me,O,se.data)):t.texImage3D(i.TEXTURE_3D,0,re,se.width,se.height,se.depth,0,me,O,se.data);else if(M.isFramebufferTexture){if(Ae)if(ye)t.texStorage2D(i.TEXTURE_2D,lt,re,se.width,se.height);else{let ue=se.width,qe=se.height;for(let ct=0;ct<lt;ct++)t.texImage2D(i.TEXTURE_2D,ct,re,ue,qe,0,me,O,null),ue>>=1,qe>>=1}}else if(M.isHTMLTexture){if("texElementImage2D"in i){let ue=i.canvas;if(ue.hasAttribute("layoutsubtree")||ue.setAttribute("layoutsubtree","true"),se.parentNode!==ue){ue.appendChild(se),d.add(M),ue.onpaint=qe=>{let ct=qe.changedElements;for(let Ne of d)ct.includes(Ne.image)&&(Ne.needsUpdate=!0)},ue.requestPaint();return}if(i.texElementImage2D.length===3)i.texElementImage2D(i.TEXTURE_2D,i.RGBA8,se);else{let ct=i.RGBA,Ne=i.RGBA,_t=i.UNSIGNED_BYTE;i.texElementImage2D(i.TEXTURE_2D,0,ct,Ne,_t,se)}i.texParameteri(i.TEXTURE_2D,i.TEXTURE_MIN_FILTER,i.LINEAR),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_S,i.CLAMP_TO_EDGE),i.texParameteri(i.TEXTURE_2D,i.TEXTURE_WRAP_T,i.CLAMP_TO_EDGE)}}else if(Re.length>0){if(ye&&Ae){let ue=je(Re[0]);t.texStorage2D(i.TEXTURE_2D,lt,re,ue.width,ue.height)}for(let ue=0,qe=Re.length;ue<qe;ue++)ie=Re[ue],ye?Ke&&t.texSubImage2D(i.TEXTURE_2D,ue,0,0,me,O,ie):t.texImage2D(i.TEXTURE_2D,ue,re,me,O,ie);M.generateMipmaps=!1}else if(ye){if(Ae){let ue=je(se);t.texStorage2D(i.TEXTURE_2D,lt,re,ue.width,ue.height)}Ke&&t.texSubImage2D(i.TEXTURE_2D,0,0,0,me,O,se)}else t.texImage2D(i.TEXTURE_2D,0,re,me,O,se);T(M)&&M.mipmapsAutoUpdate===!0&&y(de),Ee.__version=Me.version,M.onUpdate&&M.onUpdate(M)}R.__version=M.version}function Be(R,M,q){if(M.image.length!==6)return;let de=it(R,M),ae=M.source;t.bindTexture(i.TEXTURE_CUBE_MAP,R.__webglTexture,i.TEXTURE0+q);let Me=n.get(ae);if(ae.version!==Me.__version||de===!0){t.activeTexture(i.TEXTURE0+q);let Ee=Tt.getPrimaries(Tt.workingColorSpace),ne=M.colorSpace===xs?null:Tt.getPrimaries(M.colorSpace),se=M.colorSpace===xs||Ee===ne?i.NONE:i.BROWSER_DEFAULT_WEBGL;t.pixelStorei(i.UNPACK_FLIP_Y_WEBGL,M.flipY),t.pixelStorei(i.UNPACK_PREMULTIPLY_ALPHA_WEBGL,M.premultiplyAlpha),t.pixelStorei(i.UNPACK_ALIGNMENT,M.unpackAlignment),t.pixelStorei(i.UNPACK_COLORSPACE_CONVERSION_WEBGL,se);let me=M.isCompressedTexture||M.image[0].isCompressedTexture,O=M.image[0]&&M.image[0].isDataTexture,re=[];for(let Ne=0;Ne<6;Ne++)!me&&!O?re[Ne]=S(M.image[Ne],!0,s.maxCubemapSize):re[Ne]=O?M.image[Ne].image:M.image[Ne],re[Ne]=$e(M,re[Ne]);let ie=re[0],Re=r.convert(M.format,M.colorSpace),ye=r.convert(M.type),Ae=A(M.internalFormat,Re,ye,M.normalized,M.colorSpace),Ke=M.isVideoTexture!==!0,lt=Me.__version===void 0||de===!0,ue=ae.dataReady,qe=E(M,ie);rt(i.TEXTURE_CUBE_MAP,M);let ct;if(M.isDepthTexture){if(Ae=v(M.format===vs,M.type),lt)if(Ke)t.texStorage2D(i.TEXTURE_CUBE_MAP,1,Ae,ie.width,ie.height);else for(let Ne=0;Ne<6;Ne++)t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,Ae,ie.width,ie.height,0,Re,ye,null)}else if(me){Ke&&lt&&t.texStorage2D(i.TEXTURE_CUBE_MAP,qe,Ae,ie.width,ie.height);for(let Ne=0;Ne<6;Ne++){ct=re[Ne].mipmaps;for(let _t=0;_t<ct.length;_t++){let Xt=ct[_t];M.format!==Li?Re!==null?Ke?ue&&t.compressedTexSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,0,0,Xt.width,Xt.height,Re,Xt.data):t.compressedTexImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,Ae,Xt.width,Xt.height,0,Xt.data):tt("WebGLRenderer: Attempt to load unsupported compressed texture format in .setTextureCube()"):Ke?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,0,0,Xt.width,Xt.height,Re,ye,Xt.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t,Ae,Xt.width,Xt.height,0,Re,ye,Xt.data)}}}else{if(ct=M.mipmaps,Ke&&lt){ct.length>0&&qe++;let Ne=je(re[0]);t.texStorage2D(i.TEXTURE_CUBE_MAP,qe,Ae,Ne.width,Ne.height)}for(let Ne=0;Ne<6;Ne++)if(O){Ke?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,0,0,re[Ne].width,re[Ne].height,Re,ye,re[Ne].data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,Ae,re[Ne].width,re[Ne].height,0,Re,ye,re[Ne].data);for(let _t=0;_t<ct.length;_t++){let Gn=ct[_t].image[Ne].image;Ke?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,0,0,Gn.width,Gn.height,Re,ye,Gn.data):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,Ae,Gn.width,Gn.height,0,Re,ye,Gn.data)}}else{Ke?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,0,0,Re,ye,re[Ne]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,0,Ae,Re,ye,re[Ne]);for(let _t=0;_t<ct.length;_t++){let Xt=ct[_t];Ke?ue&&t.texSubImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,0,0,Re,ye,Xt.image[Ne]):t.texImage2D(i.TEXTURE_CUBE_MAP_POSITIVE_X+Ne,_t+1,Ae,Re,ye,Xt.image[Ne])}}}T(M)&&M.mipmapsAutoUpdate===!0&&y(i.TEXTURE_CUBE_MAP),Me.__version=ae.version,M.onUpdate&&M.onUpdate(M)}R.__version=M.version}function Le(R,M,q,de,ae,Me){let Ee=r.convert(q.format,q.colorSpace),ne=r.convert(q.type),se=A(q.internalFormat,Ee,ne,q.normalized,q.colorSpace),me=n.get(M),O=n.get(q);if(O.__renderTarget=M,!me.__hasExternalTextures){let re=Math.max(1,M.width>>Me),ie=Math.max(1,M.height>>Me);ae===i.TEXTURE_3D||ae===i.TEXTURE_2D_ARRAY?t.texImage3D(ae,Me,se,re,ie,M.depth,0,Ee,ne,null):t.texImage2D(ae,Me,se,re,ie,0,Ee,ne,null)}t.bindFramebuffer(i.FRAMEBUFFER,R),we(M)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,de,ae,O.__webglTexture,0,ht(M)):(ae===i.TEXTURE_2D||ae>=i.TEXTURE_CUBE_MAP_POSITIVE_X&&ae<=i.TEXTURE_CUBE_MAP_NEGATIVE_Z)&&i.framebufferTexture2D(i.FRAMEBUFFER,de,ae,O.__webglTexture,Me),t.bindFramebuffer(i.FRAMEBUFFER,null)}function nt(R,M,q){if(i.bindRenderbuffer(i.RENDERBUFFER,R),M.depthBuffer){let de=M.depthTexture,ae=de&&de.isDepthTexture?de.type:null,Me=v(M.stencilBuffer,ae),Ee=M.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;we(M)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ht(M),Me,M.width,M.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,ht(M),Me,M.width,M.height):i.renderbufferStorage(i.RENDERBUFFER,Me,M.width,M.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,Ee,i.RENDERBUFFER,R)}else{let de=M.textures;for(let ae=0;ae<de.length;ae++){let Me=de[ae],Ee=r.convert(Me.format,Me.colorSpace),ne=r.convert(Me.type),se=A(Me.internalFormat,Ee,ne,Me.normalized,Me.colorSpace);we(M)?a.renderbufferStorageMultisampleEXT(i.RENDERBUFFER,ht(M),se,M.width,M.height):q?i.renderbufferStorageMultisample(i.RENDERBUFFER,ht(M),se,M.width,M.height):i.renderbufferStorage(i.RENDERBUFFER,se,M.width,M.height)}}i.bindRenderbuffer(i.RENDERBUFFER,null)}function ke(R,M,q){let de=M.isWebGLCubeRenderTarget===!0;if(t.bindFramebuffer(i.FRAMEBUFFER,R),!(M.depthTexture&&M.depthTexture.isDepthTexture))throw new Error("THREE.WebGLTextures: renderTarget.depthTexture must be an instance of THREE.DepthTexture.");let ae=n.get(M.depthTexture);ae.__renderTarget=M;let Me=de?M.depthTexture.image[0]:M.depthTexture.image;(!ae.__webglTexture||Me.width!==M.width||Me.height!==M.height)&&(Me.width=M.width,Me.height=M.height,M.depthTexture.needsUpdate=!0),de?be(M.depthTexture,0):ge(M.depthTexture,0);let Ee=ae.__webglTexture,ne=ht(M),se=de?i.TEXTURE_CUBE_MAP_POSITIVE_X+q:i.TEXTURE_2D,me=M.depthTexture.format===vs?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;if(M.depthTexture.format===fs)we(M)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,me,se,Ee,0,ne):i.framebufferTexture2D(i.FRAMEBUFFER,me,se,Ee,0);else if(M.depthTexture.format===vs)we(M)?a.framebufferTexture2DMultisampleEXT(i.FRAMEBUFFER,me,se,Ee,0,ne):i.framebufferTexture2D(i.FRAMEBUFFER,me,se,Ee,0);else throw new Error("THREE.WebGLTextures: Unknown depthTexture format.")}function gt(R){let M=n.get(R),q=R.isWebGLCubeRenderTarget===!0;if(M.__boundDepthTexture!==R.depthTexture){let de=R.depthTexture;if(M.__depthDisposeCallback&&M.__depthDisposeCallback(),de){let ae=()=>{delete M.__boundDepthTexture,delete M.__depthDisposeCallback,de.removeEventListener("dispose",ae)};de.addEventListener("dispose",ae),M.__depthDisposeCallback=ae}M.__boundDepthTexture=de}if(R.depthTexture&&!M.__autoAllocateDepthBuffer)if(q)for(let de=0;de<6;de++)ke(M.__webglFramebuffer[de],R,de);else R.texture.mipmaps.length>0?ke(M.__webglFramebuffer[0],R,0):ke(M.__webglFramebuffer,R,0);else if(q){M.__webglDepthbuffer=[];for(let de=0;de<6;de++)if(t.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer[de]),M.__webglDepthbuffer[de]===void 0)M.__webglDepthbuffer[de]=i.createRenderbuffer(),nt(M.__webglDepthbuffer[de],R,!1);else{let ae=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Me=M.__webglDepthbuffer[de];i.bindRenderbuffer(i.RENDERBUFFER,Me),i.framebufferRenderbuffer(i.FRAMEBUFFER,ae,i.RENDERBUFFER,Me)}}else if(R.texture.mipmaps.length>0?t.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer[0]):t.bindFramebuffer(i.FRAMEBUFFER,M.__webglFramebuffer),M.__webglDepthbuffer===void 0)M.__webglDepthbuffer=i.createRenderbuffer(),nt(M.__webglDepthbuffer,R,!1);else{let ae=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Me=M.__webglDepthbuffer;i.bindRenderbuffer(i.RENDERBUFFER,Me),i.framebufferRenderbuffer(i.FRAMEBUFFER,ae,i.RENDERBUFFER,Me)}t.bindFramebuffer(i.FRAMEBUFFER,null)}function dt(R,M,q){let de=n.get(R);M!==void 0&&Le(de.__webglFramebuffer,R,R.texture,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,0),q!==void 0&&gt(R)}function vt(R){let M=R.texture,q=n.get(R),de=n.get(M);R.addEventListener("dispose",G),k(R);let ae=R.textures,Me=R.isWebGLCubeRenderTarget===!0,Ee=ae.length>1;if(Ee||(de.__webglTexture===void 0&&(de.__webglTexture=i.createTexture()),de.__version=M.version,o.memory.textures++),Me){q.__webglFramebuffer=[];for(let ne=0;ne<6;ne++)if(M.mipmaps.length>0){q.__webglFramebuffer[ne]=[];for(let se=0;se<M.mipmaps.length;se++)q.__webglFramebuffer[ne][se]=i.createFramebuffer()}else q.__webglFramebuffer[ne]=i.createFramebuffer()}else{if(M.mipmaps.length>0){q.__webglFramebuffer=[];for(let ne=0;ne<M.mipmaps.length;ne++)q.__webglFramebuffer[ne]=i.createFramebuffer()}else q.__webglFramebuffer=i.createFramebuffer();if(Ee)for(let ne=0,se=ae.length;ne<se;ne++){let me=n.get(ae[ne]);me.__webglTexture===void 0&&(me.__webglTexture=i.createTexture(),o.memory.textures++)}if(R.samples>0&&we(R)===!1){q.__webglMultisampledFramebuffer=i.createFramebuffer(),q.__webglColorRenderbuffer=[],t.bindFramebuffer(i.FRAMEBUFFER,q.__webglMultisampledFramebuffer);for(let ne=0;ne<ae.length;ne++){let se=ae[ne];q.__webglColorRenderbuffer[ne]=i.createRenderbuffer(),i.bindRenderbuffer(i.RENDERBUFFER,q.__webglColorRenderbuffer[ne]);let me=r.convert(se.format,se.colorSpace),O=r.convert(se.type),re=A(se.internalFormat,me,O,se.normalized,se.colorSpace,R.isXRRenderTarget===!0),ie=ht(R);i.renderbufferStorageMultisample(i.RENDERBUFFER,ie,re,R.width,R.height),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+ne,i.RENDERBUFFER,q.__webglColorRenderbuffer[ne])}i.bindRenderbuffer(i.RENDERBUFFER,null),R.depthBuffer&&(q.__webglDepthRenderbuffer=i.createRenderbuffer(),nt(q.__webglDepthRenderbuffer,R,!0)),t.bindFramebuffer(i.FRAMEBUFFER,null)}}if(Me){t.bindTexture(i.TEXTURE_CUBE_MAP,de.__webglTexture),rt(i.TEXTURE_CUBE_MAP,M);for(let ne=0;ne<6;ne++)if(M.mipmaps.length>0)for(let se=0;se<M.mipmaps.length;se++)Le(q.__webglFramebuffer[ne][se],R,M,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ne,se);else Le(q.__webglFramebuffer[ne],R,M,i.COLOR_ATTACHMENT0,i.TEXTURE_CUBE_MAP_POSITIVE_X+ne,0);T(M)?y(i.TEXTURE_CUBE_MAP):M.mipmaps.length>0&&i.texParameteri(i.TEXTURE_CUBE_MAP,i.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),t.unbindTexture()}else if(Ee){for(let ne=0,se=ae.length;ne<se;ne++){let me=ae[ne],O=n.get(me),re=i.TEXTURE_2D;(R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(re=R.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(re,O.__webglTexture),rt(re,me),Le(q.__webglFramebuffer,R,me,i.COLOR_ATTACHMENT0+ne,re,0),T(me)&&y(re)}t.unbindTexture()}else{let ne=i.TEXTURE_2D;if((R.isWebGL3DRenderTarget||R.isWebGLArrayRenderTarget)&&(ne=R.isWebGL3DRenderTarget?i.TEXTURE_3D:i.TEXTURE_2D_ARRAY),t.bindTexture(ne,de.__webglTexture),rt(ne,M),M.mipmaps.length>0)for(let se=0;se<M.mipmaps.length;se++)Le(q.__webglFramebuffer[se],R,M,i.COLOR_ATTACHMENT0,ne,se);else Le(q.__webglFramebuffer,R,M,i.COLOR_ATTACHMENT0,ne,0);T(M)?y(ne):M.mipmaps.length>0&&i.texParameteri(ne,i.TEXTURE_MAX_LEVEL,M.mipmaps.length-1),t.unbindTexture()}R.depthBuffer&&gt(R)}function U(R){let M=R.textures;for(let q=0,de=M.length;q<de;q++){let ae=M[q];if(T(ae)&&ae.mipmapsAutoUpdate===!0){let Me=C(R),Ee=n.get(ae).__webglTexture;t.bindTexture(Me,Ee),y(Me),t.unbindTexture()}}}let Se=[];function Xe(R){if(R.samples>0){if(we(R)===!1){let M=R.textures,q=R.width,de=R.height,ae=i.COLOR_BUFFER_BIT,Me=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT,Ee=n.get(R),ne=M.length>1;if(ne)for(let me=0;me<M.length;me++)t.bindFramebuffer(i.FRAMEBUFFER,Ee.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+me,i.RENDERBUFFER,null),t.bindFramebuffer(i.FRAMEBUFFER,Ee.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+me,i.TEXTURE_2D,null,0);t.bindFramebuffer(i.READ_FRAMEBUFFER,Ee.__webglMultisampledFramebuffer),R.texture.mipmaps.length>0?t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Ee.__webglFramebuffer[0]):t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Ee.__webglFramebuffer);for(let me=0;me<M.length;me++){if(R.resolveDepthBuffer&&(R.depthBuffer&&(ae|=i.DEPTH_BUFFER_BIT),R.stencilBuffer&&R.resolveStencilBuffer&&(ae|=i.STENCIL_BUFFER_BIT)),ne){i.framebufferRenderbuffer(i.READ_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.RENDERBUFFER,Ee.__webglColorRenderbuffer[me]);let O=n.get(M[me]).__webglTexture;i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0,i.TEXTURE_2D,O,0)}i.blitFramebuffer(0,0,q,de,0,0,q,de,ae,i.NEAREST),l===!0&&(Se.length=0,Se.push(i.COLOR_ATTACHMENT0+me),R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&Se.push(Me),i.invalidateFramebuffer(i.READ_FRAMEBUFFER,Se))}if(t.bindFramebuffer(i.READ_FRAMEBUFFER,null),t.bindFramebuffer(i.DRAW_FRAMEBUFFER,null),ne)for(let me=0;me<M.length;me++){t.bindFramebuffer(i.FRAMEBUFFER,Ee.__webglMultisampledFramebuffer),i.framebufferRenderbuffer(i.FRAMEBUFFER,i.COLOR_ATTACHMENT0+me,i.RENDERBUFFER,Ee.__webglColorRenderbuffer[me]);let O=n.get(M[me]).__webglTexture;t.bindFramebuffer(i.FRAMEBUFFER,Ee.__webglFramebuffer),i.framebufferTexture2D(i.DRAW_FRAMEBUFFER,i.COLOR_ATTACHMENT0+me,i.TEXTURE_2D,O,0)}t.bindFramebuffer(i.DRAW_FRAMEBUFFER,Ee.__webglMultisampledFramebuffer)}else if(R.depthBuffer&&R.storeMultisampledDepthBuffer===!1&&l){let M=R.stencilBuffer?i.DEPTH_STENCIL_ATTACHMENT:i.DEPTH_ATTACHMENT;i.invalidateFramebuffer(i.DRAW_FRAMEBUFFER,[M])}}}function ht(R){return Math.min(s.maxSamples,R.samples)}function we(R){let M=n.get(R);return R.samples>0&&e.has("WEBGL_multisampled_render_to_texture")===!0&&M.__useRenderToTexture!==!1}function Nt(R){let M=o.render.frame;h.get(R)!==M&&(h.set(R,M),R.update())}function $e(R,M){let q=R.colorSpace,de=R.format,ae=R.type;return R.isCompressedTexture===!0||R.isVideoTexture===!0||q!==ia&&q!==xs&&(Tt.getTransfer(q)===Ut?(de!==Li||ae!==jn)&&tt("WebGLTextures: sRGB encoded textures have to use RGBAFormat and UnsignedByteType."):at("WebGLTextures: Unsupported texture color space:",q)),M}function je(R){return typeof HTMLImageElement<"u"&&R instanceof HTMLImageElement?(c.width=R.naturalWidth||R.width,c.height=R.naturalHeight||R.height):typeof VideoFrame<"u"&&R instanceof VideoFrame?(c.width=R.displayWidth,c.height=R.displayHeight):(c.width=R.width,c.height=R.height),c}this.allocateTextureUnit=he,this.resetTextureUnits=j,this.getTextureUnits=te,this.setTextureUnits=fe,this.setTexture2D=ge,this.setTexture2DArray=ve,this.setTexture3D=Ie,this.setTextureCube=be,this.rebindTextures=dt,this.setupRenderTarget=vt,this.updateRenderTargetMipmap=U,this.updateMultisampleRenderTarget=Xe,this.setupDepthRenderbuffer=gt,this.setupFrameBufferTexture=Le,this.useMultisampledRTT=we,this.dispose=H}function Lb(i,e){function t(n,s=xs){let r,o=Tt.getTransfer(s);if(n===jn)return i.UNSIGNED_BYTE;if(n===Dc)return i.UNSIGNED_SHORT_4_4_4_4;if(n===Nc)return i.UNSIGNED_SHORT_5_5_5_1;if(n===Md)return i.UNSIGNED_INT_5_9_9_9_REV;if(n===bd)return i.UNSIGNED_INT_10F_11F_11F_REV;if(n===yd)return i.BYTE;if(n===Sd)return i.SHORT;if(n===vo)return i.UNSIGNED_SHORT;if(n===Lc)return i.INT;if(n===Ci)return i.UNSIGNED_INT;if(n===Pi)return i.FLOAT;if(n===Ii)return i.HALF_FLOAT;if(n===wd)return i.ALPHA;if(n===Ed)return i.RGB;if(n===Li)return i.RGBA;if(n===fs)return i.DEPTH_COMPONENT;if(n===vs)return i.DEPTH_STENCIL;if(n===Td)return i.RED;if(n===Uc)return i.RED_INTEGER;if(n===Gs)return i.RG;if(n===Fc)return i.RG_INTEGER;if(n===Oc)return i.RGBA_INTEGER;if(n===Ua||n===Fa||n===Oa||n===Ba)if(o===Ut)if(r=e.get("WEBGL_compressed_texture_s3tc_srgb"),r!==null){if(n===Ua)return r.COMPRESSED_SRGB_S3TC_DXT1_EXT;if(n===Fa)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT1_EXT;if(n===Oa)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT3_EXT;if(n===Ba)return r.COMPRESSED_SRGB_ALPHA_S3TC_DXT5_EXT}else return null;else if(r=e.get("WEBGL_compressed_texture_s3tc"),r!==null){if(n===Ua)return r.COMPRESSED_RGB_S3TC_DXT1_EXT;if(n===Fa)return r.COMPRESSED_RGBA_S3TC_DXT1_EXT;if(n===Oa)return r.COMPRESSED_RGBA_S3TC_DXT3_EXT;if(n===Ba)return r.COMPRESSED_RGBA_S3TC_DXT5_EXT}else return null;if(n===Bc||n===kc||n===zc||n===Hc)if(r=e.get("WEBGL_compressed_texture_pvrtc"),r!==null){if(n===Bc)return r.COMPRESSED_RGB_PVRTC_4BPPV1_IMG;if(n===kc)return r.COMPRESSED_RGB_PVRTC_2BPPV1_IMG;if(n===zc)return r.COMPRESSED_RGBA_PVRTC_4BPPV1_IMG;if(n===Hc)return r.COMPRESSED_RGBA_PVRTC_2BPPV1_IMG}else return null;if(n===Gc||n===Vc||n===Wc||n===Xc||n===qc||n===ka||n===Yc)if(r=e.get("WEBGL_compressed_texture_etc"),r!==null){if(n===Gc||n===Vc)return o===Ut?r.COMPRESSED_SRGB8_ETC2:r.COMPRESSED_RGB8_ETC2;if(n===Wc)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ETC2_EAC:r.COMPRESSED_RGBA8_ETC2_EAC;if(n===Xc)return r.COMPRESSED_R11_EAC;if(n===qc)return r.COMPRESSED_SIGNED_R11_EAC;if(n===ka)return r.COMPRESSED_RG11_EAC;if(n===Yc)return r.COMPRESSED_SIGNED_RG11_EAC}else return null;if(n===$c||n===Zc||n===Jc||n===Kc||n===Qc||n===jc||n===eh||n===th||n===nh||n===ih||n===sh||n===rh||n===oh||n===ah)if(r=e.get("WEBGL_compressed_texture_astc"),r!==null){if(n===$c)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_4x4_KHR:r.COMPRESSED_RGBA_ASTC_4x4_KHR;if(n===Zc)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x4_KHR:r.COMPRESSED_RGBA_ASTC_5x4_KHR;if(n===Jc)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_5x5_KHR:r.COMPRESSED_RGBA_ASTC_5x5_KHR;if(n===Kc)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x5_KHR:r.COMPRESSED_RGBA_ASTC_6x5_KHR;if(n===Qc)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_6x6_KHR:r.COMPRESSED_RGBA_ASTC_6x6_KHR;if(n===jc)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x5_KHR:r.COMPRESSED_RGBA_ASTC_8x5_KHR;if(n===eh)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x6_KHR:r.COMPRESSED_RGBA_ASTC_8x6_KHR;if(n===th)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_8x8_KHR:r.COMPRESSED_RGBA_ASTC_8x8_KHR;if(n===nh)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x5_KHR:r.COMPRESSED_RGBA_ASTC_10x5_KHR;if(n===ih)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x6_KHR:r.COMPRESSED_RGBA_ASTC_10x6_KHR;if(n===sh)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x8_KHR:r.COMPRESSED_RGBA_ASTC_10x8_KHR;if(n===rh)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_10x10_KHR:r.COMPRESSED_RGBA_ASTC_10x10_KHR;if(n===oh)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x10_KHR:r.COMPRESSED_RGBA_ASTC_12x10_KHR;if(n===ah)return o===Ut?r.COMPRESSED_SRGB8_ALPHA8_ASTC_12x12_KHR:r.COMPRESSED_RGBA_ASTC_12x12_KHR}else return null;if(n===lh||n===ch||n===hh)if(r=e.get("EXT_texture_compression_bptc"),r!==null){if(n===lh)return o===Ut?r.COMPRESSED_SRGB_ALPHA_BPTC_UNORM_EXT:r.COMPRESSED_RGBA_BPTC_UNORM_EXT;if(n===ch)return r.COMPRESSED_RGB_BPTC_SIGNED_FLOAT_EXT;if(n===hh)return r.COMPRESSED_RGB_BPTC_UNSIGNED_FLOAT_EXT}else return null;if(n===uh||n===dh||n===za||n===fh)if(r=e.get("EXT_texture_compression_rgtc"),r!==null){if(n===uh)return r.COMPRESSED_RED_RGTC1_EXT;if(n===dh)return r.COMPRESSED_SIGNED_RED_RGTC1_EXT;if(n===za)return r.COMPRESSED_RED_GREEN_RGTC2_EXT;if(n===fh)return r.COMPRESSED_SIGNED_RED_GREEN_RGTC2_EXT}else return null;return n===fr?i.UNSIGNED_INT_24_8:i[n]!==void 0?i[n]:null}return{convert:t}}var Db=`
void main() {

	gl_Position = vec4( position, 1.0 );

}`,Nb=`
uniform sampler2DArray depthColor;
uniform float depthWidth;
uniform float depthHeight;

void main() {

	vec2 coord = vec2( gl_FragCoord.x / depthWidth, gl_FragCoord.y / depthHeight );

	if ( coord.x >= 1.0 ) {

		gl_FragDepth = texture( depthColor, vec3( coord.x - 1.0, coord.y, 1 ) ).r;

	} else {

		gl_FragDepth = texture( depthColor, vec3( coord.x, coord.y, 0 ) ).r;

	}

}`,Kd=class{constructor(){this.texture=null,this.mesh=null,this.depthNear=0,this.depthFar=0}init(e,t){if(this.texture===null){let n=new _a(e.texture);(e.depthNear!==t.depthNear||e.depthFar!==t.depthFar)&&(this.depthNear=e.depthNear,this.depthFar=e.depthFar),this.texture=n}}getMesh(e){if(this.texture!==null&&this.mesh===null){let t=e.cameras[0].viewport,n=new Ji({vertexShader:Db,fragmentShader:Nb,uniforms:{depthColor:{value:this.texture},depthWidth:{value:t.z},depthHeight:{value:t.w}}});this.mesh=new kn(new Ta(20,20),n)}return this.mesh}reset(){this.texture=null,this.mesh=null}getDepthTexture(){return this.texture}},Qd=class extends $i{constructor(e,t){super();let n=this,s=null,r=1,o=null,a="local-floor",l=1,c=null,h=null,d=null,u=null,f=null,p=null,x=typeof XRWebGLBinding<"u",m=new Kd,g={},S=t.getContextAttributes(),T=null,y=null,C=[],A=[],v=new De,E=null,k=null,N=new Nn;N.viewport=new tn;let I=new Nn;I.viewport=new tn;let G=[N,I],W=new Tc,L=null,H=null;this.cameraAutoUpdate=!0,this.enabled=!1,this.isPresenting=!1,this.getController=function(ee){let ge=C[ee];return ge===void 0&&(ge=new so,C[ee]=ge),ge.getTargetRaySpace()},this.getControllerGrip=function(ee){let ge=C[ee];return ge===void 0&&(ge=new so,C[ee]=ge),ge.getGripSpace()},this.getHand=function(ee){let ge=C[ee];return ge===void 0&&(ge=new so,C[ee]=ge),ge.getHandSpace()};function Y(ee){let ge=A.indexOf(ee.inputSource);if(ge===-1)return;let ve=C[ge];ve!==void 0&&(ve.update(ee.inputSource,ee.frame,c||o),ve.dispatchEvent({type:ee.type,data:ee.inputSource}))}function z(){s.removeEventListener("select",Y),s.removeEventListener("selectstart",Y),s.removeEventListener("selectend",Y),s.removeEventListener("squeeze",Y),s.removeEventListener("squeezestart",Y),s.removeEventListener("squeezeend",Y),s.removeEventListener("end",z),s.removeEventListener("inputsourceschange",ce);for(let ee=0;ee<C.length;ee++){let ge=A[ee];ge!==null&&(A[ee]=null,C[ee].disconnect(ge))}L=null,H=null,m.reset();for(let ee in g)delete g[ee];if(e.setRenderTarget(T),f=null,u=null,d=null,s=null,y=null,he.stop(),n.isPresenting=!1,e.setPixelRatio(E),e.setSize(v.width,v.height,!1),k!==null){let ee=k.camera;ee.fov=k.fov,ee.zoom=k.zoom,ee.updateProjectionMatrix(),k=null}n.dispatchEvent({type:"sessionend"})}this.setFramebufferScaleFactor=function(ee){r=ee,n.isPresenting===!0&&tt("WebXRManager: Cannot change framebuffer scale while presenting.")},this.setReferenceSpaceType=function(ee){a=ee,n.isPresenting===!0&&tt("WebXRManager: Cannot change reference space type while presenting.")},this.getReferenceSpace=function(){return c||o},this.setReferenceSpace=function(ee){c=ee},this.getBaseLayer=function(){return u!==null?u:f},this.getBinding=function(){return d===null&&x&&(d=new XRWebGLBinding(s,t)),d},this.getFrame=function(){return p},this.getSession=function(){return s},this.setSession=async function(ee){if(s=ee,s!==null){if(T=e.getRenderTarget(),s.addEventListener("select",Y),s.addEventListener("selectstart",Y),s.addEventListener("selectend",Y),s.addEventListener("squeeze",Y),s.addEventListener("squeezestart",Y),s.addEventListener("squeezeend",Y),s.addEventListener("end",z),s.addEventListener("inputsourceschange",ce),S.xrCompatible!==!0&&await t.makeXRCompatible(),E=e.getPixelRatio(),e.getSize(v),x&&"createProjectionLayer"in XRWebGLBinding.prototype){let ve=null,Ie=null,be=null;S.depth&&(be=S.stencil?t.DEPTH24_STENCIL8:t.DEPTH_COMPONENT24,ve=S.stencil?vs:fs,Ie=S.stencil?fr:Ci);let Ge={colorFormat:t.RGBA8,depthFormat:be,scaleFactor:r};d=this.getBinding(),u=d.createProjectionLayer(Ge),s.updateRenderState({layers:[u]}),e.setPixelRatio(1),e.setSize(u.textureWidth,u.textureHeight,!1),y=new oi(u.textureWidth,u.textureHeight,{format:Li,type:jn,depthTexture:new gs(u.textureWidth,u.textureHeight,Ie,void 0,void 0,void 0,void 0,void 0,void 0,ve),stencilBuffer:S.stencil,colorSpace:e.outputColorSpace,samples:S.antialias?4:0,resolveDepthBuffer:u.ignoreDepthValues===!1,resolveStencilBuffer:u.ignoreDepthValues===!1,storeMultisampledDepthBuffer:u.ignoreDepthValues===!1,storeMultisampledStencilBuffer:u.ignoreDepthValues===!1})}else{let ve={antialias:S.antialias,alpha:!0,depth:S.depth,stencil:S.stencil,framebufferScaleFactor:r};f=new XRWebGLLayer(s,t,ve),s.updateRenderState({baseLayer:f}),e.setPixelRatio(1),e.setSize(f.framebufferWidth,f.framebufferHeight,!1),y=new oi(f.framebufferWidth,f.framebufferHeight,{format:Li,type:jn,colorSpace:e.outputColorSpace,stencilBuffer:S.stencil,resolveDepthBuffer:f.ignoreDepthValues===!1,resolveStencilBuffer:f.ignoreDepthValues===!1,storeMultisampledDepthBuffer:f.ignoreDepthValues===!1,storeMultisampledStencilBuffer:f.ignoreDepthValues===!1})}y.isXRRenderTarget=!0,this.setFoveation(l),c=null,o=await s.requestReferenceSpace(a),he.setContext(s),he.start(),n.isPresenting=!0,n.dispatchEvent({type:"sessionstart"})}},this.getEnvironmentBlendMode=function(){if(s!==null)return s.environmentBlendMode},this.getDepthTexture=function(){return m.getDepthTexture()};function ce(ee){for(let ge=0;ge<ee.removed.length;ge++){let ve=ee.removed[ge],Ie=A.indexOf(ve);Ie>=0&&(A[Ie]=null,C[Ie].disconnect(ve))}for(let ge=0;ge<ee.added.length;ge++){let ve=ee.added[ge],Ie=A.indexOf(ve);if(Ie===-1){for(let Ge=0;Ge<C.length;Ge++)if(Ge>=A.length){A.push(ve),Ie=Ge;break}else if(A[Ge]===null){A[Ge]=ve,Ie=Ge;break}if(Ie===-1)break}let be=C[Ie];be&&be.connect(ve)}}function J(ee,ge){ge===null?ee.matrixWorld.copy(ee.matrix):ee.matrixWorld.multiplyMatrices(ge.matrixWorld,ee.matrix),ee.matrixWorldInverse.copy(ee.matrixWorld).invert()}this.updateCamera=function(ee){if(s===null)return;let ge=ee.near,ve=ee.far;m.texture!==null&&(m.depthNear>0&&(ge=m.depthNear),m.depthFar>0&&(ve=m.depthFar)),W.near=I.near=N.near=ge,W.far=I.far=N.far=ve,(L!==W.near||H!==W.far)&&(s.updateRenderState({depthNear:W.near,depthFar:W.far}),L=W.near,H=W.far),W.layers.mask=ee.layers.mask|6,N.layers.mask=W.layers.mask&-5,I.layers.mask=W.layers.mask&-3;let Ie=ee.parent,be=W.cameras;J(W,Ie);for(let Ge=0;Ge<be.length;Ge++)J(be[Ge],Ie);W.projectionMatrix.copy(N.projectionMatrix),W.projectionMatrixInverse.copy(N.projectionMatrixInverse),k===null&&ee.isPerspectiveCamera&&(k={camera:ee,fov:ee.fov,zoom:ee.zoom}),j(ee,W,Ie)};function j(ee,ge,ve){ve===null?ee.matrix.copy(ge.matrixWorld):(ee.matrix.copy(ve.matrixWorld),ee.matrix.invert(),ee.matrix.multiply(ge.matrixWorld)),ee.matrix.decompose(ee.position,ee.quaternion,ee.scale),ee.updateMatrixWorld(!0),ee.projectionMatrix.copy(ge.projectionMatrix),ee.projectionMatrixInverse.copy(ge.projectionMatrixInverse),ee.isPerspectiveCamera&&(ee.fov=Ql*2*Math.atan(1/ee.projectionMatrix.elements[5]),ee.zoom=1)}this.getCamera=function(){return W},this.getFoveation=function(){if(!(u===null&&f===null))return l},this.setFoveation=function(ee){l=ee,u!==null&&(u.fixedFoveation=ee),f!==null&&f.fixedFoveation!==void 0&&(f.fixedFoveation=ee)},this.hasDepthSensing=function(){return m.texture!==null},this.getDepthSensingMesh=function(){return m.getMesh(W)},this.getCameraTexture=function(ee){return g[ee]};let te=null;function fe(ee,ge){if(h=ge.getViewerPose(c||o),p=ge,h!==null){let ve=h.views;f!==null&&(e.setRenderTargetFramebuffer(y,f.framebuffer),e.setRenderTarget(y));let Ie=!1;ve.length!==W.cameras.length&&(W.cameras.length=0,Ie=!0);for(let Je=0;Je<ve.length;Je++){let rt=ve[Je],it=null;if(f!==null)it=f.getViewport(rt);else{let xe=d.getViewSubImage(u,rt);it=xe.viewport,Je===0&&(e.setRenderTargetTextures(y,xe.colorTexture,xe.depthStencilTexture),e.setRenderTarget(y))}let oe=G[Je];oe===void 0&&(oe=new Nn,oe.layers.enable(Je),oe.viewport=new tn,G[Je]=oe),oe.matrix.fromArray(rt.transform.matrix),oe.matrix.decompose(oe.position,oe.quaternion,oe.scale),oe.projectionMatrix.fromArray(rt.projectionMatrix),oe.projectionMatrixInverse.copy(oe.projectionMatrix).invert(),oe.viewport.set(it.x,it.y,it.width,it.height),Je===0&&(W.matrix.copy(oe.matrix),W.matrix.decompose(W.position,W.quaternion,W.scale)),Ie===!0&&W.cameras.push(oe)}let be=s.enabledFeatures;if(be&&be.includes("depth-sensing")&&s.depthUsage=="gpu-optimized"&&x){d=n.getBinding();let Je=d.getDepthInformation(ve[0]);Je&&Je.isValid&&Je.texture&&m.init(Je,s.renderState)}if(be&&be.includes("camera-access")&&x){e.state.unbindTexture(),d=n.getBinding();for(let Je=0;Je<ve.length;Je++){let rt=ve[Je].camera;if(rt){let it=g[rt];it||(it=new _a,g[rt]=it);let oe=d.getCameraImage(rt);it.sourceTexture=oe}}}}for(let ve=0;ve<C.length;ve++){let Ie=A[ve],be=C[ve];Ie!==null&&be!==void 0&&be.update(Ie,ge,c||o)}te&&te(ee,ge),ge.detectedPlanes&&n.dispatchEvent({type:"planesdetected",data:ge}),p=null}let he=new vg;he.setAnimationLoop(fe),this.setAnimationLoop=function(ee){te=ee},this.dispose=function(){}}},Ub=new Ft,Rg=new ft;Rg.set(-1,0,0,0,1,0,0,0,1);function Fb(i,e){function t(m,g){m.matrixAutoUpdate===!0&&m.updateMatrix(),g.value.copy(m.matrix)}function n(m,g){g.color.getRGB(m.fogColor.value,Nd(i)),g.isFog?(m.fogNear.value=g.near,m.fogFar.value=g.far):g.isFogExp2&&(m.fogDensity.value=g.density)}function s(m,g,S,T,y){g.isNodeMaterial?g.uniformsNeedUpdate=!1:g.isMeshBasicMaterial?r(m,g):g.isMeshLambertMaterial?(r(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshToonMaterial?(r(m,g),d(m,g)):g.isMeshPhongMaterial?(r(m,g),h(m,g),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)):g.isMeshStandardMaterial?(r(m,g),u(m,g),g.isMeshPhysicalMaterial&&f(m,g,y)):g.isMeshMatcapMaterial?(r(m,g),p(m,g)):g.isMeshDepthMaterial?r(m,g):g.isMeshDistanceMaterial?(r(m,g),x(m,g)):g.isMeshNormalMaterial?r(m,g):g.isLineBasicMaterial?(o(m,g),g.isLineDashedMaterial&&a(m,g)):g.isPointsMaterial?l(m,g,S,T):g.isSpriteMaterial?c(m,g):g.isShadowMaterial?(m.color.value.copy(g.color),m.opacity.value=g.opacity):g.isShaderMaterial&&(g.uniformsNeedUpdate=!1)}function r(m,g){m.opacity.value=g.opacity,g.color&&m.diffuse.value.copy(g.color),g.emissive&&m.emissive.value.copy(g.emissive).multiplyScalar(g.emissiveIntensity),g.map&&(m.map.value=g.map,t(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.bumpMap&&(m.bumpMap.value=g.bumpMap,t(g.bumpMap,m.bumpMapTransform),m.bumpScale.value=g.bumpScale,g.side===Kn&&(m.bumpScale.value*=-1)),g.normalMap&&(m.normalMap.value=g.normalMap,t(g.normalMap,m.normalMapTransform),m.normalScale.value.copy(g.normalScale),g.side===Kn&&m.normalScale.value.negate()),g.displacementMap&&(m.displacementMap.value=g.displacementMap,t(g.displacementMap,m.displacementMapTransform),m.displacementScale.value=g.displacementScale,m.displacementBias.value=g.displacementBias),g.emissiveMap&&(m.emissiveMap.value=g.emissiveMap,t(g.emissiveMap,m.emissiveMapTransform)),g.specularMap&&(m.specularMap.value=g.specularMap,t(g.specularMap,m.specularMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest);let S=e.get(g),T=S.envMap,y=S.envMapRotation;T&&(m.envMap.value=T,m.envMapRotation.value.setFromMatrix4(Ub.makeRotationFromEuler(y)).transpose(),T.isCubeTexture&&T.isRenderTargetTexture===!1&&m.envMapRotation.value.premultiply(Rg),m.reflectivity.value=g.reflectivity,m.ior.value=g.ior,m.refractionRatio.value=g.refractionRatio),g.lightMap&&(m.lightMap.value=g.lightMap,m.lightMapIntensity.value=g.lightMapIntensity,t(g.lightMap,m.lightMapTransform)),g.aoMap&&(m.aoMap.value=g.aoMap,m.aoMapIntensity.value=g.aoMapIntensity,t(g.aoMap,m.aoMapTransform))}function o(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,g.map&&(m.map.value=g.map,t(g.map,m.mapTransform))}function a(m,g){m.dashSize.value=g.dashSize,m.totalSize.value=g.dashSize+g.gapSize,m.scale.value=g.scale}function l(m,g,S,T){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.size.value=g.size*S,m.scale.value=T*.5,g.map&&(m.map.value=g.map,t(g.map,m.uvTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function c(m,g){m.diffuse.value.copy(g.color),m.opacity.value=g.opacity,m.rotation.value=g.rotation,g.map&&(m.map.value=g.map,t(g.map,m.mapTransform)),g.alphaMap&&(m.alphaMap.value=g.alphaMap,t(g.alphaMap,m.alphaMapTransform)),g.alphaTest>0&&(m.alphaTest.value=g.alphaTest)}function h(m,g){m.specular.value.copy(g.specular),m.shininess.value=Math.max(g.shininess,1e-4)}function d(m,g){g.gradientMap&&(m.gradientMap.value=g.gradientMap)}function u(m,g){m.metalness.value=g.metalness,g.metalnessMap&&(m.metalnessMap.value=g.metalnessMap,t(g.metalnessMap,m.metalnessMapTransform)),m.roughness.value=g.roughness,g.roughnessMap&&(m.roughnessMap.value=g.roughnessMap,t(g.roughnessMap,m.roughnessMapTransform)),g.envMap&&(m.envMapIntensity.value=g.envMapIntensity)}function f(m,g,S){m.ior.value=g.ior,g.diffuseRoughness>0&&(m.diffuseRoughness.value=g.diffuseRoughness,g.diffuseRoughnessMap&&(m.diffuseRoughnessMap.value=g.diffuseRoughnessMap,t(g.diffuseRoughnessMap,m.diffuseRoughnessMapTransform))),g.sheen>0&&(m.sheenColor.value.copy(g.sheenColor).multiplyScalar(g.sheen),m.sheenRoughness.value=g.sheenRoughness,g.sheenColorMap&&(m.sheenColorMap.value=g.sheenColorMap,t(g.sheenColorMap,m.sheenColorMapTransform)),g.sheenRoughnessMap&&(m.sheenRoughnessMap.value=g.sheenRoughnessMap,t(g.sheenRoughnessMap,m.sheenRoughnessMapTransform))),g.clearcoat>0&&(m.clearcoat.value=g.clearcoat,m.clearcoatRoughness.value=g.clearcoatRoughness,g.clearcoatMap&&(m.clearcoatMap.value=g.clearcoatMap,t(g.clearcoatMap,m.clearcoatMapTransform)),g.clearcoatRoughnessMap&&(m.clearcoatRoughnessMap.value=g.clearcoatRoughnessMap,t(g.clearcoatRoughnessMap,m.clearcoatRoughnessMapTransform)),g.clearcoatNormalMap&&(m.clearcoatNormalMap.value=g.clearcoatNormalMap,t(g.clearcoatNormalMap,m.clearcoatNormalMapTransform),m.clearcoatNormalScale.value.copy(g.clearcoatNormalScale),g.side===Kn&&m.clearcoatNormalScale.value.negate())),g.dispersion>0&&(m.dispersion.value=g.dispersion),g.retroreflectivity>0&&(m.retroreflectivity.value=g.retroreflectivity),g.iridescence>0&&(m.iridescence.value=g.iridescence,m.iridescenceIOR.value=g.iridescenceIOR,m.iridescenceThicknessMinimum.value=g.iridescenceThicknessMinimum,m.iridescenceThicknessMaximum.value=g.iridescenceThicknessMaximum,g.iridescenceMap&&(m.iridescenceMap.value=g.iridescenceMap,t(g.iridescenceMap,m.iridescenceMapTransform)),g.iridescenceThicknessMap&&(m.iridescenceThicknessMap.value=g.iridescenceThicknessMap,t(g.iridescenceThicknessMap,m.iridescenceThicknessMapTransform))),g.transmission>0&&(m.transmission.value=g.transmission,m.transmissionSamplerMap.value=S.texture,m.transmissionSamplerSize.value.set(S.width,S.height),g.transmissionMap&&(m.transmissionMap.value=g.transmissionMap,t(g.transmissionMap,m.transmissionMapTransform)),m.thickness.value=g.thickness,g.thicknessMap&&(m.thicknessMap.value=g.thicknessMap,t(g.thicknessMap,m.thicknessMapTransform)),m.attenuationDistance.value=g.attenuationDistance,m.attenuationColor.value.copy(g.attenuationColor)),g.anisotropy>0&&(m.anisotropyVector.value.set(g.anisotropy*Math.cos(g.anisotropyRotation),g.anisotropy*Math.sin(g.anisotropyRotation)),g.anisotropyMap&&(m.anisotropyMap.value=g.anisotropyMap,t(g.anisotropyMap,m.anisotropyMapTransform))),m.specularIntensity.value=g.specularIntensity,m.specularColor.value.copy(g.specularColor),g.specularColorMap&&(m.specularColorMap.value=g.specularColorMap,t(g.specularColorMap,m.specularColorMapTransform)),g.specularIntensityMap&&(m.specularIntensityMap.value=g.specularIntensityMap,t(g.specularIntensityMap,m.specularIntensityMapTransform))}function p(m,g){g.matcap&&(m.matcap.value=g.matcap)}function x(m,g){let S=e.get(g).light;m.referencePosition.value.setFromMatrixPosition(S.matrixWorld),m.nearDistance.value=S.shadow.camera.near,m.farDistance.value=S.shadow.camera.far}return{refreshFogUniforms:n,refreshMaterialUniforms:s}}function Ob(i,e,t,n){let s={},r={};function o(S,T){let y=T.program;n.uniformBlockBinding(S,y,s[S.id])}function a(S,T){let y=s[S.id];y===void 0&&(p(S),y=l(S),s[S.id]=y,S.addEventListener("dispose",m));let C=T.program;n.updateUBOMapping(S,C);let A=e.render.frame;r[S.id]!==A&&(c(S),r[S.id]=A)}function l(S){let T=i.createBuffer(),y=S.__size,C=S.usage;return i.bindBuffer(i.UNIFORM_BUFFER,T),i.bufferData(i.UNIFORM_BUFFER,y,C),i.bindBuffer(i.UNIFORM_BUFFER,null),T}function c(S){let T=s[S.id],y=S.uniforms,C=S.__cache;i.bindBuffer(i.UNIFORM_BUFFER,T);for(let A=0,v=y.length;A<v;A++){let E=y[A];if(Array.isArray(E))for(let k=0,N=E.length;k<N;k++)h(E[k],A,k,C);else h(E,A,0,C)}i.bindBuffer(i.UNIFORM_BUFFER,null)}function h(S,T,y,C){if(u(S,T,y,C)===!0){let A=S.__offset,v=S.value;if(Array.isArray(v)){let E=0;for(let k=0;k<v.length;k++){let N=v[k],I=x(N,!0);d(N,S.__data,E),E+=I.storage/Float32Array.BYTES_PER_ELEMENT}}else d(v,S.__data,0);i.bufferSubData(i.UNIFORM_BUFFER,A,S.__data)}}function d(S,T,y){typeof S=="number"||typeof S=="boolean"?T[y]=S:S.isMatrix3?(T[y]=S.elements[0],T[y+1]=S.elements[1],T[y+2]=S.elements[2],T[y+3]=0,T[y+4]=S.elements[3],T[y+5]=S.elements[4],T[y+6]=S.elements[5],T[y+7]=0,T[y+8]=S.elements[6],T[y+9]=S.elements[7],T[y+10]=S.elements[8],T[y+11]=0):ArrayBuffer.isView(S)?T.set(S.subarray(0,T.length-y),y):S.toArray(T,y)}function u(S,T,y,C){let A=S.value,v=T+"_"+y;if(Array.isArray(A)){C[v]===void 0&&(C[v]=[]);let E=C[v],k=!1;for(let N=0;N<A.length;N++)f(A[N],E,N)===!0&&(k=!0);return k}return f(A,C,v)}function f(S,T,y){if(T[y]===void 0)return typeof S=="number"||typeof S=="boolean"?T[y]=S:ArrayBuffer.isView(S)?T[y]=S.slice():T[y]=S.clone(),!0;{let C=T[y];if(typeof S=="number"||typeof S=="boolean"){if(C!==S)return T[y]=S,!0}else{if(ArrayBuffer.isView(S))return!0;if(C.equals(S)===!1)return C.copy(S),!0}}return!1}function p(S){let T=S.uniforms,y=0,C=16;for(let v=0,E=T.length;v<E;v++){let k=Array.isArray(T[v])?T[v]:[T[v]];for(let N=0,I=k.length;N<I;N++){let G=k[N],W=Array.isArray(G.value)?G.value:[G.value],L=Array.isArray(T[v])||Array.isArray(G.value),H=y;for(let z=0,ce=W.length;z<ce;z++){let J=W[z],j=x(J,L),te=y%C,fe=te%j.boundary,he=te+fe;y+=fe,he!==0&&C-he<j.storage&&(y+=C-he),z===0&&(H=y),y+=j.storage}let Y=G.type==="int"?Int32Array:G.type==="uint"?Uint32Array:Float32Array;G.__data=new Y((y-H)/Float32Array.BYTES_PER_ELEMENT),G.__offset=H}}let A=y%C;return A>0&&(y+=C-A),S.__size=y,S.__cache={},this}function x(S,T){let y={boundary:0,storage:0};return typeof S=="number"||typeof S=="boolean"?(y.boundary=4,y.storage=4):S.isVector2?(y.boundary=8,y.storage=8):S.isVector3||S.isColor?(y.boundary=16,y.storage=12):S.isVector4?(y.boundary=16,y.storage=16):S.isMatrix3?(y.boundary=16,y.storage=48):S.isMatrix4?(y.boundary=16,y.storage=64):S.isTexture?tt("WebGLRenderer: Texture samplers can not be part of an uniforms group."):ArrayBuffer.isView(S)?(y.boundary=16,y.storage=S.byteLength):tt("WebGLRenderer: Unsupported uniform value type.",S),T===!0&&(y.boundary=16,y.storage=Math.ceil(y.storage/16)*16),y}function m(S){let T=S.target;T.removeEventListener("dispose",m),i.deleteBuffer(s[T.id]),delete s[T.id],delete r[T.id]}function g(){for(let S in s)i.deleteBuffer(s[S]);s={},r={}}return{bind:o,update:a,dispose:g}}var Bb=new Uint16Array([12469,15057,12620,14925,13266,14620,13807,14376,14323,13990,14545,13625,14713,13328,14840,12882,14931,12528,14996,12233,15039,11829,15066,11525,15080,11295,15085,10976,15082,10705,15073,10495,13880,14564,13898,14542,13977,14430,14158,14124,14393,13732,14556,13410,14702,12996,14814,12596,14891,12291,14937,11834,14957,11489,14958,11194,14943,10803,14921,10506,14893,10278,14858,9960,14484,14039,14487,14025,14499,13941,14524,13740,14574,13468,14654,13106,14743,12678,14818,12344,14867,11893,14889,11509,14893,11180,14881,10751,14852,10428,14812,10128,14765,9754,14712,9466,14764,13480,14764,13475,14766,13440,14766,13347,14769,13070,14786,12713,14816,12387,14844,11957,14860,11549,14868,11215,14855,10751,14825,10403,14782,10044,14729,9651,14666,9352,14599,9029,14967,12835,14966,12831,14963,12804,14954,12723,14936,12564,14917,12347,14900,11958,14886,11569,14878,11247,14859,10765,14828,10401,14784,10011,14727,9600,14660,9289,14586,8893,14508,8533,15111,12234,15110,12234,15104,12216,15092,12156,15067,12010,15028,11776,14981,11500,14942,11205,14902,10752,14861,10393,14812,9991,14752,9570,14682,9252,14603,8808,14519,8445,14431,8145,15209,11449,15208,11451,15202,11451,15190,11438,15163,11384,15117,11274,15055,10979,14994,10648,14932,10343,14871,9936,14803,9532,14729,9218,14645,8742,14556,8381,14461,8020,14365,7603,15273,10603,15272,10607,15267,10619,15256,10631,15231,10614,15182,10535,15118,10389,15042,10167,14963,9787,14883,9447,14800,9115,14710,8665,14615,8318,14514,7911,14411,7507,14279,7198,15314,9675,15313,9683,15309,9712,15298,9759,15277,9797,15229,9773,15166,9668,15084,9487,14995,9274,14898,8910,14800,8539,14697,8234,14590,7790,14479,7409,14367,7067,14178,6621,15337,8619,15337,8631,15333,8677,15325,8769,15305,8871,15264,8940,15202,8909,15119,8775,15022,8565,14916,8328,14804,8009,14688,7614,14569,7287,14448,6888,14321,6483,14088,6171,15350,7402,15350,7419,15347,7480,15340,7613,15322,7804,15287,7973,15229,8057,15148,8012,15046,7846,14933,7611,14810,7357,14682,7069,14552,6656,14421,6316,14251,5948,14007,5528,15356,5942,15356,5977,15353,6119,15348,6294,15332,6551,15302,6824,15249,7044,15171,7122,15070,7050,14949,6861,14818,6611,14679,6349,14538,6067,14398,5651,14189,5311,13935,4958,15359,4123,15359,4153,15356,4296,15353,4646,15338,5160,15311,5508,15263,5829,15188,6042,15088,6094,14966,6001,14826,5796,14678,5543,14527,5287,14377,4985,14133,4586,13869,4257,15360,1563,15360,1642,15358,2076,15354,2636,15341,3350,15317,4019,15273,4429,15203,4732,15105,4911,14981,4932,14836,4818,14679,4621,14517,4386,14359,4156,14083,3795,13808,3437,15360,122,15360,137,15358,285,15355,636,15344,1274,15322,2177,15281,2765,15215,3223,15120,3451,14995,3569,14846,3567,14681,3466,14511,3305,14344,3121,14037,2800,13753,2467,15360,0,15360,1,15359,21,15355,89,15346,253,15325,479,15287,796,15225,1148,15133,1492,15008,1749,14856,1882,14685,1886,14506,1783,14324,1608,13996,1398,13702,1183]),Qi=null;function kb(){return Qi===null&&(Qi=new nc(Bb,16,16,Gs,Ii),Qi.name="DFG_LUT",Qi.minFilter=Zn,Qi.magFilter=Zn,Qi.wrapS=qi,Qi.wrapT=qi,Qi.generateMipmaps=!1,Qi.needsUpdate=!0),Qi}var xh=class{constructor(e={}){let{canvas:t=Um(),context:n=null,depth:s=!0,stencil:r=!1,alpha:o=!1,antialias:a=!1,premultipliedAlpha:l=!0,preserveDrawingBuffer:c=!1,powerPreference:h="default",failIfMajorPerformanceCaveat:d=!1,reversedDepthBuffer:u=!1,outputBufferType:f=jn}=e;this.isWebGLRenderer=!0;let p;if(n!==null){if(typeof WebGLRenderingContext<"u"&&n instanceof WebGLRenderingContext)throw new Error("THREE.WebGLRenderer: WebGL 1 is not supported since r163.");p=n.getContextAttributes().alpha}else p=o;let x=f,m=new Set([Oc,Fc,Uc]),g=new Set([jn,Ci,vo,fr,Dc,Nc]),S=new Uint32Array(4),T=new Int32Array(4),y={textures:[],min:[],max:[],resolution:[]},C=null,A=null,v=[],E=[],k=null;this.domElement=t,this.debug={checkShaderErrors:!0,diagnostics:{keywords:!1},onShaderError:null},this.autoClear=!0,this.autoClearColor=!0,this.autoClearDepth=!0,this.autoClearStencil=!0,this.sortObjects=!0,this.clippingPlanes=[],this.localClippingEnabled=!1,this.toneMapping=Ki,this.toneMappingExposure=1,this.transmissionResolutionScale=1;let N=this,I=!1,G=null,W=null,L=null,H=null;this._outputColorSpace=$n;let Y=0,z=0,ce=null,J=-1,j=null,te=new tn,fe=new tn,he=null,ee=new pt(0),ge=0,ve=t.width,Ie=t.height,be=1,Ge=null,st=null,Je=new tn(0,0,ve,Ie),rt=new tn(0,0,ve,Ie),it=!1,oe=new Fs,xe=new ic,_e=!1,Be=!1,Le=new Ft,nt=new X,ke=new tn,gt={background:null,fog:null,environment:null,overrideMaterial:null,isScene:!0},dt=!1;function vt(){return ce===null?be:1}let U=n;function Se(w,B){return t.getContext(w,B)}let Xe,ht,we,Nt,$e,je,R,M,q,de,ae,Me,Ee,ne,se,me,O,re,ie,Re,ye,Ae,Ke;try{let w={alpha:!0,depth:s,stencil:r,antialias:a,premultipliedAlpha:l,preserveDrawingBuffer:c,powerPreference:h,failIfMajorPerformanceCaveat:d};if("setAttribute"in t&&t.setAttribute("data-engine",`three.js r${"187"}`),t.addEventListener("webglcontextlost",qe,!1),t.addEventListener("webglcontextrestored",ct,!1),t.addEventListener("webglcontextcreationerror",Ne,!1),U===null){let B="webgl2";if(U=Se(B,w),U===null)throw Se(B)?new Error("THREE.WebGLRenderer: Error creating WebGL context with your selected attributes."):new Error("THREE.WebGLRenderer: Error creating WebGL context.")}lt()}catch(w){throw t.removeEventListener("webglcontextlost",qe,!1),t.removeEventListener("webglcontextrestored",ct,!1),t.removeEventListener("webglcontextcreationerror",Ne,!1),at("WebGLRenderer: "+w.message),w}function lt(){Xe=new JS(U),Xe.init(),ye=new Lb(U,Xe),ht=new kS(U,Xe,e,ye),we=new Pb(U,Xe),ht.reversedDepthBuffer&&u&&we.buffers.depth.setReversed(!0),W=U.createFramebuffer(),L=U.createFramebuffer(),H=U.createFramebuffer(),Nt=new jS(U),$e=new gb,je=new Ib(U,Xe,we,$e,ht,ye,Nt),R=new ZS(N),M=new tx(U),Ae=new OS(U,M),q=new KS(U,M,Nt,Ae),de=new tM(U,q,M,Ae,Nt),re=new eM(U,ht,je),se=new zS($e),ae=new mb(N,R,Xe,ht,Ae,se),Me=new Fb(N,$e),Ee=new vb,ne=new wb(Xe),O=new FS(N,R,we,de,p,l),me=new Cb(N,de,ht),Ke=new Ob(U,Nt,ht,we),ie=new BS(U,Xe,Nt),Re=new QS(U,Xe,Nt),Nt.programs=ae.programs,N.capabilities=ht,N.extensions=Xe,N.properties=$e,N.renderLists=Ee,N.shadowMap=me,N.state=we,N.info=Nt}x!==jn&&(k=new iM(x,t.width,t.height,a,s,r));let ue=new Qd(N,U);this.xr=ue,this.getContext=function(){return U},this.getContextAttributes=function(){return U.getContextAttributes()},this.forceContextLoss=function(){let w=Xe.get("WEBGL_lose_context");w&&w.loseContext()},this.forceContextRestore=function(){let w=Xe.get("WEBGL_lose_context");w&&w.restoreContext()},this.getPixelRatio=function(){return be},this.setPixelRatio=function(w){w!==void 0&&(be=w,this.setSize(ve,Ie,!1))},this.getSize=function(w){return w.set(ve,Ie)},this.setSize=function(w,B,Q=!0){if(ue.isPresenting){tt("WebGLRenderer: Can't change size while VR device is presenting.");return}ve=w,Ie=B,t.width=Math.floor(w*be),t.height=Math.floor(B*be),Q===!0&&(t.style.width=w+"px",t.style.height=B+"px"),k!==null&&k.setSize(t.width,t.height),this.setViewport(0,0,w,B)},this.getDrawingBufferSize=function(w){return w.set(ve*be,Ie*be).floor()},this.setDrawingBufferSize=function(w,B,Q){ve=w,Ie=B,be=Q,t.width=Math.floor(w*Q),t.height=Math.floor(B*Q),this.setViewport(0,0,w,B)},this.setEffects=function(w){if(x===jn){at("WebGLRenderer: setEffects() requires outputBufferType set to HalfFloatType or FloatType.");return}if(w){for(let B=0;B<w.length;B++)if(w[B].isOutputPass===!0){tt("WebGLRenderer: OutputPass is not needed in setEffects(). Tone mapping and color space conversion are applied automatically.");break}}k.setEffects(w||[])},this.getCurrentViewport=function(w){return w.copy(te)},this.getViewport=function(w){return w.copy(Je)},this.setViewport=function(w,B,Q,$){w.isVector4?Je.set(w.x,w.y,w.z,w.w):Je.set(w,B,Q,$),we.viewport(te.copy(Je).multiplyScalar(vt()).round())},this.getScissor=function(w){return w.copy(rt)},this.setScissor=function(w,B,Q,$){w.isVector4?rt.set(w.x,w.y,w.z,w.w):rt.set(w,B,Q,$),we.scissor(fe.copy(rt).multiplyScalar(vt()).round())},this.getScissorTest=function(){return it},this.setScissorTest=function(w){we.setScissorTest(it=w)},this.setOpaqueSort=function(w){Ge=w},this.setTransparentSort=function(w){st=w},this.getClearColor=function(w){return w.copy(O.getClearColor())},this.setClearColor=function(){O.setClearColor(...arguments)},this.getClearAlpha=function(){return O.getClearAlpha()},this.setClearAlpha=function(){O.setClearAlpha(...arguments)},this.clear=function(w=!0,B=!0,Q=!0){let $=0;if(w){let Z=!1;if(ce!==null){let Ce=ce.texture.format;Z=m.has(Ce)}if(Z){let Ce=ce.texture.type,Ue=g.has(Ce),Pe=O.getClearColor(),Fe=O.getClearAlpha(),Ze=Pe.r,ut=Pe.g,St=Pe.b;Ue?(S[0]=Ze,S[1]=ut,S[2]=St,S[3]=Fe,U.clearBufferuiv(U.COLOR,0,S)):(T[0]=Ze,T[1]=ut,T[2]=St,T[3]=Fe,U.clearBufferiv(U.COLOR,0,T))}else $|=U.COLOR_BUFFER_BIT}B&&($|=U.DEPTH_BUFFER_BIT,this.state.buffers.depth.setMask(!0)),Q&&($|=U.STENCIL_BUFFER_BIT,this.state.buffers.stencil.setMask(4294967295)),$!==0&&U.clear($)},this.clearColor=function(){this.clear(!0,!1,!1)},this.clearDepth=function(){this.clear(!1,!0,!1)},this.clearStencil=function(){this.clear(!1,!1,!0)},this.setNodesHandler=function(w){w.setRenderer(this),G=w},this.dispose=function(){t.removeEventListener("webglcontextlost",qe,!1),t.removeEventListener("webglcontextrestored",ct,!1),t.removeEventListener("webglcontextcreationerror",Ne,!1),O.dispose(),Ee.dispose(),ne.dispose(),je.dispose(),$e.dispose(),R.dispose(),de.dispose(),q.dispose(),Ae.dispose(),Ke.dispose(),ae.dispose(),ue.dispose(),ue.removeEventListener("sessionstart",sl),ue.removeEventListener("sessionend",Oi),ns.stop()};function qe(w){w.preventDefault(),oa("WebGLRenderer: Context Lost."),I=!0}function ct(){oa("WebGLRenderer: Context Restored."),I=!1;let w=Nt.autoReset,B=me.enabled,Q=me.autoUpdate,$=me.needsUpdate,Z=me.type;lt(),Nt.autoReset=w,me.enabled=B,me.autoUpdate=Q,me.needsUpdate=$,me.type=Z}function Ne(w){at("WebGLRenderer: A WebGL context could not be created. Reason: ",w.statusMessage)}function _t(w){let B=w.target;B.removeEventListener("dispose",_t),Xt(B)}function Xt(w){Gn(w),$e.remove(w)}function Gn(w){let B=$e.get(w).programs;B!==void 0&&(B.forEach(function(Q){ae.releaseProgram(Q)}),w.isShaderMaterial&&ae.releaseShaderCache(w))}this.renderBufferDirect=function(w,B,Q,$,Z,Ce){B===null&&(B=gt);let Ue=Z.isMesh&&Z.matrixWorld.determinantAffine()<0,Pe=ko(w,B,Q,$,Z);we.setMaterial($,Ue);let Fe=Q.index,Ze=1;if($.wireframe===!0){if(Fe=q.getWireframeAttribute(Q),Fe===void 0)return;Ze=2}let ut=Q.drawRange,St=Q.attributes.position,Ye=ut.start*Ze,Mt=(ut.start+ut.count)*Ze;Ce!==null&&(Ye=Math.max(Ye,Ce.start*Ze),Mt=Math.min(Mt,(Ce.start+Ce.count)*Ze)),Fe!==null?(Ye=Math.max(Ye,0),Mt=Math.min(Mt,Fe.count)):St!=null&&(Ye=Math.max(Ye,0),Mt=Math.min(Mt,St.count));let nn=Mt-Ye;if(nn<0||nn===1/0)return;Ae.setup(Z,$,Pe,Q,Fe);let Bt,kt=ie;if(Fe!==null&&(Bt=M.get(Fe),kt=Re,kt.setIndex(Bt)),Z.isMesh)$.wireframe===!0?(we.setLineWidth($.wireframeLinewidth*vt()),kt.setMode(U.LINES)):kt.setMode(U.TRIANGLES);else if(Z.isLine){let _n=$.linewidth;_n===void 0&&(_n=1),we.setLineWidth(_n*vt()),Z.isLineSegments?kt.setMode(U.LINES):Z.isLineLoop?kt.setMode(U.LINE_LOOP):kt.setMode(U.LINE_STRIP)}else Z.isPoints?kt.setMode(U.POINTS):Z.isSprite&&kt.setMode(U.TRIANGLES);if(Z.isBatchedMesh)if(Xe.get("WEBGL_multi_draw"))kt.renderMultiDraw(Z._multiDrawStarts,Z._multiDrawCounts,Z._multiDrawCount);else{let _n=Z._multiDrawStarts,Ve=Z._multiDrawCounts,un=Z._multiDrawCount,Et=Fe?M.get(Fe).bytesPerElement:1,ss=$e.get($).currentProgram.getUniforms();for(let dn=0;dn<un;dn++)ss.setValue(U,"_gl_DrawID",dn),kt.render(_n[dn]/Et,Ve[dn])}else if(Z.isInstancedMesh)kt.renderInstances(Ye,nn,Z.count);else if(Q.isInstancedBufferGeometry){let _n=Q._maxInstanceCount!==void 0?Q._maxInstanceCount:1/0,Ve=Math.min(Q.instanceCount,_n);kt.renderInstances(Ye,nn,Ve)}else kt.render(Ye,nn)};function Fo(w,B,Q,$){G!==null&&w.isNodeMaterial&&G.setObject($,w),_e===!0&&se.setState(w,Q,!1),w.transparent===!0&&w.side===ci&&w.forceSinglePass===!1?(w.side=Kn,w.needsUpdate=!0,Bi(w,B,$),w.side=Hs,w.needsUpdate=!0,Bi(w,B,$),w.side=ci):Bi(w,B,$)}this.compile=function(w,B,Q=null){Q===null&&(Q=w),G!==null&&G.renderStart(w,B,Q),A=ne.get(Q),A.init(B),E.push(A),Q.traverseVisible(function(Z){Z.isLight&&Z.layers.test(B.layers)&&(A.pushLight(Z),Z.castShadow&&A.pushShadow(Z))}),w!==Q&&w.traverseVisible(function(Z){Z.isLight&&Z.layers.test(B.layers)&&(A.pushLight(Z),Z.castShadow&&A.pushShadow(Z))}),A.setupLights(),G!==null&&G.updateLights(A.state.lightsArray),Be=this.localClippingEnabled,_e=se.init(this.clippingPlanes,Be),_e===!0&&se.setGlobalState(this.clippingPlanes,B),G!==null&&me.render(A.state.shadowsArray,Q,B);let $=new Set;return w.traverse(function(Z){if(!(Z.isMesh||Z.isPoints||Z.isLine||Z.isSprite))return;let Ce=Z.material;if(Ce)if(Array.isArray(Ce))for(let Ue=0;Ue<Ce.length;Ue++){let Pe=Ce[Ue];Fo(Pe,Q,B,Z),$.add(Pe)}else Fo(Ce,Q,B,Z),$.add(Ce)}),A=E.pop(),G!==null&&G.renderEnd(),$},this.compileAsync=function(w,B,Q=null){let $=this.compile(w,B,Q);return new Promise(Z=>{function Ce(){if($.forEach(function(Ue){let Fe=$e.get(Ue).currentProgram;(Fe===void 0||Fe.isReady())&&$.delete(Ue)}),$.size===0){Z(w);return}setTimeout(Ce,10)}Xe.get("KHR_parallel_shader_compile")!==null?Ce():setTimeout(Ce,10)})};let Er=null;function du(w){Er&&Er(w)}function sl(){ns.stop()}function Oi(){ns.start()}let ns=new vg;ns.setAnimationLoop(du),typeof self<"u"&&ns.setContext(self),this.setAnimationLoop=function(w){Er=w,ue.setAnimationLoop(w),w===null?ns.stop():ns.start()},ue.addEventListener("sessionstart",sl),ue.addEventListener("sessionend",Oi),this.render=function(w,B){if(B!==void 0&&B.isCamera!==!0){at("WebGLRenderer.render: camera is not an instance of THREE.Camera.");return}if(I===!0)return;G!==null&&G.renderStart(w,B);let Q=ue.enabled===!0&&ue.isPresenting===!0,$=k!==null&&(ce===null||Q)&&k.begin(N,ce);if(w.matrixWorldAutoUpdate===!0&&w.updateMatrixWorld(),B.parent===null&&B.matrixWorldAutoUpdate===!0&&B.updateMatrixWorld(),ue.enabled===!0&&ue.isPresenting===!0&&(k===null||k.isCompositing()===!1)&&(ue.cameraAutoUpdate===!0&&ue.updateCamera(B),B=ue.getCamera()),w.isScene===!0&&w.onBeforeRender(N,w,B,ce),A=ne.get(w,E.length),A.init(B),A.state.textureUnits=je.getTextureUnits(),E.push(A),Le.multiplyMatrices(B.projectionMatrix,B.matrixWorldInverse),B.isArrayCamera?xe.setFromArrayCamera(B):oe.setFromProjectionMatrix(Le,gi,B.reversedDepth),Be=this.localClippingEnabled,_e=se.init(this.clippingPlanes,Be),C=Ee.get(w,v.length),C.init(),v.push(C),this.info.render.frame++,ue.enabled===!0&&ue.isPresenting===!0){let Ue=N.xr.getDepthSensingMesh();Ue!==null&&is(Ue,B,-1/0,N.sortObjects)}is(w,B,0,N.sortObjects),C.finish(),G!==null&&G.updateLights(A.state.lightsArray),N.sortObjects===!0&&C.sort(Ge,st),dt=ue.enabled===!1||ue.isPresenting===!1||ue.hasDepthSensing()===!1,dt&&O.addToRenderList(C,w),this.info.autoReset===!0&&this.info.reset(),_e===!0&&se.beginShadows();let Z=A.state.shadowsArray;if(me.render(Z,w,B),_e===!0&&se.endShadows(),($&&k.hasRenderPass())===!1){let Ue=C.opaque,Pe=C.transmissive;if(A.setupLights(),B.isArrayCamera){let Fe=B.cameras;if(Pe.length>0)for(let Ze=0,ut=Fe.length;Ze<ut;Ze++){let St=Fe[Ze];yi(Ue,Pe,w,St)}dt&&O.render(w);for(let Ze=0,ut=Fe.length;Ze<ut;Ze++){let St=Fe[Ze];Oo(C,w,St,St.viewport)}}else Pe.length>0&&yi(Ue,Pe,w,B),dt&&O.render(w),Oo(C,w,B)}ce!==null&&z===0&&(je.updateMultisampleRenderTarget(ce),je.updateRenderTargetMipmap(ce)),$&&k.end(N),w.isScene===!0&&w.onAfterRender(N,w,B),Ae.resetDefaultState(),J=-1,j=null,E.pop(),E.length>0?(A=E[E.length-1],je.setTextureUnits(A.state.textureUnits),_e===!0&&se.setGlobalState(N.clippingPlanes,A.state.camera)):A=null,v.pop(),v.length>0?C=v[v.length-1]:C=null,G!==null&&G.renderEnd()};function is(w,B,Q,$){if(w.visible===!1)return;if(w.layers.test(B.layers)){if(w.isGroup)Q=w.renderOrder;else if(w.isLOD)w.autoUpdate===!0&&w.update(B);else if(w.isLight)A.pushLight(w),w.castShadow&&A.pushShadow(w);else if(w.isSprite){let Ue=B.isArrayCamera?xe:oe;if(!w.frustumCulled||w.intersectsFrustum(Ue)){$&&ke.setFromMatrixPosition(w.matrixWorld).applyMatrix4(Le);let Pe=de.update(w),Fe=w.material;Fe.visible&&C.push(w,Pe,Fe,Q,ke.z,null,B)}}else if(w.isMesh||w.isLine||w.isPoints){let Ue=B.isArrayCamera?xe:oe;if(!w.frustumCulled||w.intersectsFrustum(Ue)){let Pe=de.update(w),Fe=w.material;if($&&(w.boundingSphere!==void 0?(w.boundingSphere===null&&w.computeBoundingSphere(),ke.copy(w.boundingSphere.center)):(Pe.boundingSphere===null&&Pe.computeBoundingSphere(),ke.copy(Pe.boundingSphere.center)),ke.applyMatrix4(w.matrixWorld).applyMatrix4(Le)),Array.isArray(Fe)){let Ze=Pe.groups;for(let ut=0,St=Ze.length;ut<St;ut++){let Ye=Ze[ut],Mt=Fe[Ye.materialIndex];Mt&&Mt.visible&&C.push(w,Pe,Mt,Q,ke.z,Ye,B)}}else Fe.visible&&C.push(w,Pe,Fe,Q,ke.z,null,B)}}}let Ce=w.children;for(let Ue=0,Pe=Ce.length;Ue<Pe;Ue++)is(Ce[Ue],B,Q,$)}function Oo(w,B,Q,$){let{opaque:Z,transmissive:Ce,transparent:Ue}=w;A.setupLightsView(Q),_e===!0&&se.setGlobalState(N.clippingPlanes,Q),$&&we.viewport(te.copy($)),Z.length>0&&rn(Z,B,Q),Ce.length>0&&rn(Ce,B,Q),Ue.length>0&&rn(Ue,B,Q),we.buffers.depth.setTest(!0),we.buffers.depth.setMask(!0),we.buffers.color.setMask(!0),we.setPolygonOffset(!1)}function yi(w,B,Q,$){if((Q.isScene===!0?Q.overrideMaterial:null)!==null)return;if(A.state.transmissionRenderTarget[$.id]===void 0){let Ye=Xe.has("EXT_color_buffer_half_float")||Xe.has("EXT_color_buffer_float");A.state.transmissionRenderTarget[$.id]=new oi(1,1,{generateMipmaps:!0,type:Ye?Ii:jn,minFilter:_s,samples:Math.max(4,ht.samples),stencilBuffer:r,resolveDepthBuffer:!1,resolveStencilBuffer:!1,storeMultisampledDepthBuffer:!1,storeMultisampledStencilBuffer:!1,colorSpace:Tt.workingColorSpace})}let Ce=A.state.transmissionRenderTarget[$.id],Ue=$.viewport||te;Ce.setSize(Ue.z*N.transmissionResolutionScale,Ue.w*N.transmissionResolutionScale);let Pe=N.getRenderTarget(),Fe=N.getActiveCubeFace(),Ze=N.getActiveMipmapLevel();N.setRenderTarget(Ce),N.getClearColor(ee),ge=N.getClearAlpha(),ge<1&&N.setClearColor(16777215,.5),N.clear(),dt&&O.render(Q);let ut=N.toneMapping;N.toneMapping=Ki;let St=$.viewport;if($.viewport!==void 0&&($.viewport=void 0),A.setupLightsView($),_e===!0&&se.setGlobalState(N.clippingPlanes,$),rn(w,Q,$),je.updateMultisampleRenderTarget(Ce),je.updateRenderTargetMipmap(Ce),Xe.has("WEBGL_multisampled_render_to_texture")===!1){let Ye=!1;for(let Mt=0,nn=B.length;Mt<nn;Mt++){let Bt=B[Mt],{object:kt,geometry:_n,material:Ve,group:un}=Bt;if(Ve.side===ci&&kt.layers.test($.layers)){let Et=Ve.side;Ve.side=Kn,Ve.needsUpdate=!0,cn(kt,Q,$,_n,Ve,un),Ve.side=Et,Ve.needsUpdate=!0,Ye=!0}}Ye===!0&&(je.updateMultisampleRenderTarget(Ce),je.updateRenderTargetMipmap(Ce))}N.setRenderTarget(Pe,Fe,Ze),N.setClearColor(ee,ge),St!==void 0&&($.viewport=St),N.toneMapping=ut}function rn(w,B,Q){let $=B.isScene===!0?B.overrideMaterial:null;for(let Z=0,Ce=w.length;Z<Ce;Z++){let Ue=w[Z],{object:Pe,geometry:Fe,group:Ze}=Ue,ut=Ue.material;ut.allowOverride===!0&&$!==null&&(ut=$),Pe.layers.test(Q.layers)&&cn(Pe,B,Q,Fe,ut,Ze)}}function cn(w,B,Q,$,Z,Ce){G!==null&&Z.isNodeMaterial&&G.setObject(w,Z),w.onBeforeRender(N,B,Q,$,Z,Ce),w.modelViewMatrix.multiplyMatrices(Q.matrixWorldInverse,w.matrixWorld),w.normalMatrix.getNormalMatrix(w.modelViewMatrix),Z.onBeforeRender(N,B,Q,$,w,Ce),Z.transparent===!0&&Z.side===ci&&Z.forceSinglePass===!1?(Z.side=Kn,Z.needsUpdate=!0,N.renderBufferDirect(Q,B,$,Z,w,Ce),Z.side=Hs,Z.needsUpdate=!0,N.renderBufferDirect(Q,B,$,Z,w,Ce),Z.side=ci):N.renderBufferDirect(Q,B,$,Z,w,Ce),w.onAfterRender(N,B,Q,$,Z,Ce)}function hn(w){let B=0;for(let Q of w)Q.texture!==null&&B++;return B}function Bi(w,B,Q){B.isScene!==!0&&(B=gt);let $=$e.get(w),Z=A.state.lights,Ce=A.state.shadowsArray,Ue=Z.state.version,Pe=ae.getParameters(w,Z.state,Ce,B,Q,A.state.lightProbeGridArray),Fe=ae.getProgramCacheKey(Pe),Ze=$.programs;$.environment=w.isMeshStandardMaterial||w.isMeshLambertMaterial||w.isMeshPhongMaterial?B.environment:null,$.fog=B.fog;let ut=w.isMeshStandardMaterial||w.isMeshLambertMaterial&&!w.envMap||w.isMeshPhongMaterial&&!w.envMap;$.envMap=R.get(w.envMap||$.environment,ut),$.envMapRotation=$.environment!==null&&w.envMap===null?B.environmentRotation:w.envMapRotation,Ze===void 0&&(w.addEventListener("dispose",_t),Ze=new Map,$.programs=Ze,$.programVariants=new Map);let St=Ze.get(Fe);if(St!==void 0){if($.currentProgram===St&&$.lightsStateVersion===Ue)return Bo(w,Pe),St}else Pe.uniforms=ae.getUniforms(w),G!==null&&w.isNodeMaterial&&G.build(w,Q,Pe),w.onBeforeCompile(Pe,N),St=ae.acquireProgram(Pe,Fe),Ze.set(Fe,St),$.uniforms=Pe.uniforms;let Ye=$.uniforms;return(!w.isShaderMaterial&&!w.isRawShaderMaterial||w.clipping===!0)&&(Ye.clippingPlanes=se.uniform),Bo(w,Pe),$.needsLights=bs(w),$.lightsStateVersion=Ue,$.needsLights&&(Ye.ambientLightColor.value=Z.state.ambient,Ye.lightProbe.value=Z.state.probe,Ye.sunLights.value=Z.state.sun,Ye.sunLightShadows.value=Z.state.sunShadow,Ye.directionalLights.value=Z.state.directional,Ye.directionalLightShadows.value=Z.state.directionalShadow,Ye.spotLights.value=Z.state.spot,Ye.spotLightShadows.value=Z.state.spotShadow,Ye.rectAreaLights.value=Z.state.rectArea,Ye.ltc_1.value=Z.state.rectAreaLTC1,Ye.ltc_2.value=Z.state.rectAreaLTC2,Ye.pointLights.value=Z.state.point,Ye.pointLightShadows.value=Z.state.pointShadow,Ye.hemisphereLights.value=Z.state.hemi,Ye.sunShadowMatrix.value=Z.state.sunShadowMatrix,Ye.sunShadowCascade.value=Z.state.sunShadowCascade,Ye.directionalShadowMatrix.value=Z.state.directionalShadowMatrix,Ye.spotLightMatrix.value=Z.state.spotLightMatrix,Ye.spotLightMap.value=Z.state.spotLightMap,Ye.pointShadowMatrix.value=Z.state.pointShadowMatrix),$.numLightProbeGrids=hn(A.state.lightProbeGridArray),$.currentProgram=St,$.uniformsList=null,St}function ei(w,B,Q,$,Z){let Ce=$e.get(w),Ue=Ce.currentProgram.id+","+$+","+Z,Pe=Ce.programVariants.get(Ue);return Pe===void 0?(Pe=Bi(w,B,Q),Ce.programVariants.set(Ue,Pe)):(Ce.currentProgram=Pe,Ce.uniformsList=null,Ce.outputColorSpace=$,Ce.toneMapping=Z),Pe}function Ms(w){if(w.uniformsList===null){let B=w.currentProgram.getUniforms();w.uniformsList=xo.seqWithValue(B.seq,w.uniforms)}return w.uniformsList}function Bo(w,B){let Q=$e.get(w);Q.outputColorSpace=B.outputColorSpace,Q.batching=B.batching,Q.batchingColor=B.batchingColor,Q.instancing=B.instancing,Q.instancingColor=B.instancingColor,Q.instancingMorph=B.instancingMorph,Q.skinning=B.skinning,Q.morphTargets=B.morphTargets,Q.morphNormals=B.morphNormals,Q.morphColors=B.morphColors,Q.morphTargetsCount=B.morphTargetsCount,Q.numClippingPlanes=B.numClippingPlanes,Q.numIntersection=B.numClipIntersection,Q.vertexAlphas=B.vertexAlphas,Q.vertexTangents=B.vertexTangents,Q.toneMapping=B.toneMapping}function ko(w,B,Q,$,Z){B.isScene!==!0&&(B=gt),je.resetTextureUnits();let Ce=B.fog,Ue=$.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial?B.environment:null,Pe=ce===null?N.outputColorSpace:ce.isXRRenderTarget===!0?ce.texture.colorSpace:Tt.workingColorSpace,Fe=$.isMeshStandardMaterial||$.isMeshLambertMaterial&&!$.envMap||$.isMeshPhongMaterial&&!$.envMap,Ze=R.get($.envMap||Ue,Fe),ut=$.vertexColors===!0&&!!Q.attributes.color&&Q.attributes.color.itemSize===4,St=!!Q.attributes.tangent&&(!!$.normalMap||$.anisotropy>0),Ye=!!Q.morphAttributes.position,Mt=!!Q.morphAttributes.normal,nn=!!Q.morphAttributes.color,Bt=Ki;$.toneMapped&&(ce===null||ce.isXRRenderTarget===!0)&&(Bt=N.toneMapping);let kt=Q.morphAttributes.position||Q.morphAttributes.normal||Q.morphAttributes.color,_n=kt!==void 0?kt.length:0,Ve=$e.get($),un=A.state.lights;if(_e===!0&&(Be===!0||w!==j)){let zt=w===j&&$.id===J;se.setState($,w,zt)}let Et=!1,ss=!1;$.version===Ve.__version?Ve.needsLights&&Ve.lightsStateVersion!==un.state.version||Z.isBatchedMesh&&Ve.batching===!1||!Z.isBatchedMesh&&Ve.batching===!0||Z.isBatchedMesh&&Ve.batchingColor===!0&&Z._colorsTexture===null||Z.isBatchedMesh&&Ve.batchingColor===!1&&Z._colorsTexture!==null||Z.isInstancedMesh&&Ve.instancing===!1||!Z.isInstancedMesh&&Ve.instancing===!0||Z.isSkinnedMesh&&Ve.skinning===!1||!Z.isSkinnedMesh&&Ve.skinning===!0||Z.isInstancedMesh&&Ve.instancingColor===!0&&Z.instanceColor===null||Z.isInstancedMesh&&Ve.instancingColor===!1&&Z.instanceColor!==null||Z.isInstancedMesh&&Ve.instancingMorph===!0&&Z.morphTexture===null||Z.isInstancedMesh&&Ve.instancingMorph===!1&&Z.morphTexture!==null||Ve.envMap!==Ze||$.fog===!0&&Ve.fog!==Ce||Ve.numClippingPlanes!==void 0&&(Ve.numClippingPlanes!==se.numPlanes||Ve.numIntersection!==se.numIntersection)||Ve.vertexAlphas!==ut||Ve.vertexTangents!==St||Ve.morphTargets!==Ye||Ve.morphNormals!==Mt||Ve.morphColors!==nn||Ve.morphTargetsCount!==_n||Ve.numLightProbeGrids!==hn(A.state.lightProbeGridArray)?Et=!0:(Ve.outputColorSpace!==Pe||Ve.toneMapping!==Bt)&&(ss=!0):(Et=!0,Ve.__version=$.version);let dn=Ve.currentProgram;(Et===!0||ss===!0)&&(dn=ss===!0?ei($,B,Z,Pe,Bt):Bi($,B,Z),G&&$.isNodeMaterial&&G.onUpdateProgram($,dn,Ve));let Rr=!1,ki=!1,rs=!1,xt=dn.getUniforms(),on=Ve.uniforms;if(we.useProgram(dn.program)&&(Rr=!0,ki=!0,rs=!0),$.id!==J&&(J=$.id,ki=!0),Rr||j!==w){we.buffers.depth.getReversed()&&w.reversedDepth!==!0&&(w._reversedDepth=!0,w.updateProjectionMatrix()),xt.setValue(U,"projectionMatrix",w.projectionMatrix),xt.setValue(U,"viewMatrix",w.matrixWorldInverse);let fn=xt.map.cameraPosition;fn!==void 0&&fn.setValue(U,nt.setFromMatrixPosition(w.matrixWorld)),ht.logarithmicDepthBuffer&&xt.setValue(U,"logDepthBufFC",2/(Math.log(w.far+1)/Math.LN2)),($.isMeshPhongMaterial||$.isMeshToonMaterial||$.isMeshLambertMaterial||$.isMeshBasicMaterial||$.isMeshStandardMaterial||$.isShaderMaterial)&&xt.setValue(U,"isOrthographic",w.isOrthographicCamera===!0),j!==w&&(j=w,ki=!0,rs=!0)}if(Ve.needsLights&&(un.state.sunShadowMap.length>0&&xt.setValue(U,"sunShadowMap",un.state.sunShadowMap,je),un.state.directionalShadowMap.length>0&&xt.setValue(U,"directionalShadowMap",un.state.directionalShadowMap,je),un.state.spotShadowMap.length>0&&xt.setValue(U,"spotShadowMap",un.state.spotShadowMap,je),un.state.pointShadowMap.length>0&&xt.setValue(U,"pointShadowMap",un.state.pointShadowMap,je)),Z.isSkinnedMesh){xt.setOptional(U,Z,"bindMatrix"),xt.setOptional(U,Z,"bindMatrixInverse");let zt=Z.skeleton;zt&&(zt.boneTexture===null&&zt.computeBoneTexture(),xt.setValue(U,"boneTexture",zt.boneTexture,je))}Z.isBatchedMesh&&(xt.setOptional(U,Z,"batchingTexture"),xt.setValue(U,"batchingTexture",Z._matricesTexture,je),xt.setOptional(U,Z,"batchingIdTexture"),xt.setValue(U,"batchingIdTexture",Z._indirectTexture,je),xt.setOptional(U,Z,"batchingColorTexture"),Z._colorsTexture!==null&&xt.setValue(U,"batchingColorTexture",Z._colorsTexture,je));let Vn=Q.morphAttributes;if((Vn.position!==void 0||Vn.normal!==void 0||Vn.color!==void 0)&&re.update(Z,Q,dn),(ki||Ve.receiveShadow!==Z.receiveShadow)&&(Ve.receiveShadow=Z.receiveShadow,xt.setValue(U,"receiveShadow",Z.receiveShadow)),($.isMeshStandardMaterial||$.isMeshLambertMaterial||$.isMeshPhongMaterial)&&$.envMap===null&&B.environment!==null&&(on.envMapIntensity.value=B.environmentIntensity),on.dfgLUT!==void 0&&(on.dfgLUT.value=kb()),ki){if(xt.setValue(U,"toneMappingExposure",N.toneMappingExposure),Ve.needsLights&&Tr(on,rs),Ce&&$.fog===!0&&Me.refreshFogUniforms(on,Ce),Me.refreshMaterialUniforms(on,$,be,Ie,A.state.transmissionRenderTarget[w.id]),Ve.needsLights&&Ve.numLightProbeGrids>0){let zt=y,fn=0;for(let Fn of A.state.lightProbeGridArray)Fn.texture!==null&&(zt.textures[fn]=Fn.texture,zt.min[fn]=Fn.boundingBox.min,zt.max[fn]=Fn.boundingBox.max,zt.resolution[fn]=Fn.resolution,fn++);for(let Fn in zt)zt[Fn].length=fn;on.probesSH.value=zt.textures,on.probesMin.value=zt.min,on.probesMax.value=zt.max,on.probesResolution.value=zt.resolution}xo.upload(U,Ms(Ve),on,je)}if($.isShaderMaterial&&$.uniformsNeedUpdate===!0&&(xo.upload(U,Ms(Ve),on,je),$.uniformsNeedUpdate=!1),$.isSpriteMaterial&&xt.setValue(U,"center",Z.center),xt.setValue(U,"modelViewMatrix",Z.modelViewMatrix),xt.setValue(U,"normalMatrix",Z.normalMatrix),xt.setValue(U,"modelMatrix",Z.matrixWorld),$.uniformsGroups!==void 0){let zt=$.uniformsGroups;for(let fn=0,Fn=zt.length;fn<Fn;fn++){let rl=zt[fn];Ke.update(rl,dn),Ke.bind(rl,dn)}}return dn}function Tr(w,B){w.ambientLightColor.needsUpdate=B,w.lightProbe.needsUpdate=B,w.sunLights.needsUpdate=B,w.sunLightShadows.needsUpdate=B,w.directionalLights.needsUpdate=B,w.directionalLightShadows.needsUpdate=B,w.pointLights.needsUpdate=B,w.pointLightShadows.needsUpdate=B,w.spotLights.needsUpdate=B,w.spotLightShadows.needsUpdate=B,w.rectAreaLights.needsUpdate=B,w.hemisphereLights.needsUpdate=B}function bs(w){return w.isMeshLambertMaterial||w.isMeshToonMaterial||w.isMeshPhongMaterial||w.isMeshStandardMaterial||w.isShadowMaterial||w.isShaderMaterial&&w.lights===!0}this.getActiveCubeFace=function(){return Y},this.getActiveMipmapLevel=function(){return z},this.getRenderTarget=function(){return ce},this.setRenderTargetTextures=function(w,B,Q){let $=$e.get(w);$.__autoAllocateDepthBuffer=w.resolveDepthBuffer===!1,$.__autoAllocateDepthBuffer===!1&&($.__useRenderToTexture=!1),$e.get(w.texture).__webglTexture=B,$e.get(w.depthTexture).__webglTexture=$.__autoAllocateDepthBuffer?void 0:Q,$.__hasExternalTextures=!0},this.setRenderTargetFramebuffer=function(w,B){let Q=$e.get(w);Q.__webglFramebuffer=B,Q.__useDefaultFramebuffer=B===void 0},this.setRenderTarget=function(w,B=0,Q=0){ce=w,Y=B,z=Q;let $=null,Z=!1,Ce=!1;if(w){let Pe=$e.get(w);if(Pe.__useDefaultFramebuffer!==void 0){we.bindFramebuffer(U.FRAMEBUFFER,Pe.__webglFramebuffer),te.copy(w.viewport),fe.copy(w.scissor),he=w.scissorTest,we.viewport(te),we.scissor(fe),we.setScissorTest(he),J=-1;return}else if(Pe.__webglFramebuffer===void 0)je.setupRenderTarget(w);else if(Pe.__hasExternalTextures)je.rebindTextures(w,$e.get(w.texture).__webglTexture,$e.get(w.depthTexture).__webglTexture);else if(w.depthBuffer){let ut=w.depthTexture;if(Pe.__boundDepthTexture!==ut){if(ut!==null&&$e.has(ut)&&(w.width!==ut.image.width||w.height!==ut.image.height))throw new Error("THREE.WebGLRenderer: Attached DepthTexture is initialized to the incorrect size.");je.setupDepthRenderbuffer(w)}}let Fe=w.texture;(Fe.isData3DTexture||Fe.isDataArrayTexture||Fe.isCompressedArrayTexture)&&(Ce=!0);let Ze=$e.get(w).__webglFramebuffer;w.isWebGLCubeRenderTarget?(Array.isArray(Ze[B])?$=Ze[B][Q]:$=Ze[B],Z=!0):w.samples>0&&je.useMultisampledRTT(w)===!1?$=$e.get(w).__webglMultisampledFramebuffer:Array.isArray(Ze)?$=Ze[Q]:$=Ze,te.copy(w.viewport),fe.copy(w.scissor),he=w.scissorTest}else te.copy(Je).multiplyScalar(be).floor(),fe.copy(rt).multiplyScalar(be).floor(),he=it;if(Q!==0&&($=W),we.bindFramebuffer(U.FRAMEBUFFER,$)&&we.drawBuffers(w,$),we.viewport(te),we.scissor(fe),we.setScissorTest(he),Z){let Pe=$e.get(w.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_CUBE_MAP_POSITIVE_X+B,Pe.__webglTexture,Q)}else if(Ce){let Pe=B;for(let Fe=0;Fe<w.textures.length;Fe++){let Ze=$e.get(w.textures[Fe]);U.framebufferTextureLayer(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0+Fe,Ze.__webglTexture,Q,Pe)}}else if(w!==null&&Q!==0){let Pe=$e.get(w.texture);U.framebufferTexture2D(U.FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,Pe.__webglTexture,Q)}J=-1};function Ar(w){let B=$e.get(w);return(B.__readFormat!==w.format||B.__readType!==w.type)&&(B.__readFormat=w.format,B.__readType=w.type,B.__formatReadable=ht.textureFormatReadable(w.format),B.__typeReadable=ht.textureTypeReadable(w.type)),B}this.readRenderTargetPixels=function(w,B,Q,$,Z,Ce,Ue,Pe=0){if(!(w&&w.isWebGLRenderTarget)){at("WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");return}let Fe=$e.get(w).__webglFramebuffer;if(w.isWebGLCubeRenderTarget&&Ue!==void 0&&(Fe=Fe[Ue],Array.isArray(Fe)&&(Fe=Fe[0])),Fe){we.bindFramebuffer(U.FRAMEBUFFER,Fe);try{let Ze=w.textures[Pe],ut=Ze.format,St=Ze.type;w.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+Pe);let Ye=Ar(Ze);if(Ye.__formatReadable===!1){at("WebGLRenderer.readRenderTargetPixels: renderTarget is not in RGBA or implementation defined format.");return}if(Ye.__typeReadable===!1){at("WebGLRenderer.readRenderTargetPixels: renderTarget is not in UnsignedByteType or implementation defined type.");return}B>=0&&B<=w.width-$&&Q>=0&&Q<=w.height-Z&&U.readPixels(B,Q,$,Z,ye.convert(ut),ye.convert(St),Ce)}finally{let Ze=ce!==null?$e.get(ce).__webglFramebuffer:null;we.bindFramebuffer(U.FRAMEBUFFER,Ze)}}},this.readRenderTargetPixelsAsync=async function(w,B,Q,$,Z,Ce,Ue,Pe=0){if(!(w&&w.isWebGLRenderTarget))throw new Error("THREE.WebGLRenderer.readRenderTargetPixels: renderTarget is not THREE.WebGLRenderTarget.");let Fe=$e.get(w).__webglFramebuffer;if(w.isWebGLCubeRenderTarget&&Ue!==void 0&&(Fe=Fe[Ue],Array.isArray(Fe)&&(Fe=Fe[0])),Fe)if(B>=0&&B<=w.width-$&&Q>=0&&Q<=w.height-Z){we.bindFramebuffer(U.FRAMEBUFFER,Fe);let Ze=w.textures[Pe],ut=Ze.format,St=Ze.type;w.textures.length>1&&U.readBuffer(U.COLOR_ATTACHMENT0+Pe);let Ye=Ar(Ze);if(Ye.__formatReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in RGBA or implementation defined format.");if(Ye.__typeReadable===!1)throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: renderTarget is not in UnsignedByteType or implementation defined type.");let Mt=U.createBuffer();U.bindBuffer(U.PIXEL_PACK_BUFFER,Mt),U.bufferData(U.PIXEL_PACK_BUFFER,Ce.byteLength,U.STREAM_READ),U.readPixels(B,Q,$,Z,ye.convert(ut),ye.convert(St),0),U.bindBuffer(U.PIXEL_PACK_BUFFER,null);let nn=ce!==null?$e.get(ce).__webglFramebuffer:null;we.bindFramebuffer(U.FRAMEBUFFER,nn);let Bt=U.fenceSync(U.SYNC_GPU_COMMANDS_COMPLETE,0);return U.flush(),await Om(U,Bt,4),U.bindBuffer(U.PIXEL_PACK_BUFFER,Mt),U.getBufferSubData(U.PIXEL_PACK_BUFFER,0,Ce),U.bindBuffer(U.PIXEL_PACK_BUFFER,null),U.deleteBuffer(Mt),U.deleteSync(Bt),Ce}else throw new Error("THREE.WebGLRenderer.readRenderTargetPixelsAsync: requested read bounds are out of range.")},this.copyFramebufferToTexture=function(w,B=null,Q=0){let $=Math.pow(2,-Q),Z=Math.floor(w.image.width*$),Ce=Math.floor(w.image.height*$),Ue=B!==null?B.x:0,Pe=B!==null?B.y:0;je.setTexture2D(w,0),U.copyTexSubImage2D(U.TEXTURE_2D,Q,0,0,Ue,Pe,Z,Ce),we.unbindTexture()},this.copyTextureToTexture=function(w,B,Q=null,$=null,Z=0,Ce=0){let Ue,Pe,Fe,Ze,ut,St,Ye,Mt,nn,Bt=w.isCompressedTexture?w.mipmaps[Ce]:w.image;if(Q!==null)Ue=Q.max.x-Q.min.x,Pe=Q.max.y-Q.min.y,Fe=Q.isBox3?Q.max.z-Q.min.z:1,Ze=Q.min.x,ut=Q.min.y,St=Q.isBox3?Q.min.z:0;else{let xt=Math.pow(2,-Z);Ue=Math.floor(Bt.width*xt),Pe=Math.floor(Bt.height*xt),w.isDataArrayTexture?Fe=Bt.depth:w.isData3DTexture?Fe=Math.floor(Bt.depth*xt):Fe=1,Ze=0,ut=0,St=0}$!==null?(Ye=$.x,Mt=$.y,nn=$.z):(Ye=0,Mt=0,nn=0);let kt=ye.convert(B.format),_n=ye.convert(B.type),Ve;B.isData3DTexture?(je.setTexture3D(B,0),Ve=U.TEXTURE_3D):B.isDataArrayTexture||B.isCompressedArrayTexture?(je.setTexture2DArray(B,0),Ve=U.TEXTURE_2D_ARRAY):(je.setTexture2D(B,0),Ve=U.TEXTURE_2D),we.activeTexture(U.TEXTURE0),we.pixelStorei(U.UNPACK_FLIP_Y_WEBGL,B.flipY),we.pixelStorei(U.UNPACK_PREMULTIPLY_ALPHA_WEBGL,B.premultiplyAlpha),we.pixelStorei(U.UNPACK_ALIGNMENT,B.unpackAlignment);let un=we.getParameter(U.UNPACK_ROW_LENGTH),Et=we.getParameter(U.UNPACK_IMAGE_HEIGHT),ss=we.getParameter(U.UNPACK_SKIP_PIXELS),dn=we.getParameter(U.UNPACK_SKIP_ROWS),Rr=we.getParameter(U.UNPACK_SKIP_IMAGES);we.pixelStorei(U.UNPACK_ROW_LENGTH,Bt.width),we.pixelStorei(U.UNPACK_IMAGE_HEIGHT,Bt.height),we.pixelStorei(U.UNPACK_SKIP_PIXELS,Ze),we.pixelStorei(U.UNPACK_SKIP_ROWS,ut),we.pixelStorei(U.UNPACK_SKIP_IMAGES,St);let ki=w.isDataArrayTexture||w.isData3DTexture,rs=B.isDataArrayTexture||B.isData3DTexture;if(w.isDepthTexture){let xt=$e.get(w),on=$e.get(B),Vn=$e.get(xt.__renderTarget),zt=$e.get(on.__renderTarget);we.bindFramebuffer(U.READ_FRAMEBUFFER,Vn.__webglFramebuffer),we.bindFramebuffer(U.DRAW_FRAMEBUFFER,zt.__webglFramebuffer);for(let fn=0;fn<Fe;fn++)ki&&(U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,$e.get(w).__webglTexture,Z,St+fn),U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,$e.get(B).__webglTexture,Ce,nn+fn)),U.blitFramebuffer(Ze,ut,Ze+Ue,ut+Pe,Ye,Mt,Ye+Ue,Mt+Pe,U.DEPTH_BUFFER_BIT,U.NEAREST);we.bindFramebuffer(U.READ_FRAMEBUFFER,null),we.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else if(Z!==0||w.isRenderTargetTexture||$e.has(w)){let xt=$e.get(w),on=$e.get(B);we.bindFramebuffer(U.READ_FRAMEBUFFER,L),we.bindFramebuffer(U.DRAW_FRAMEBUFFER,H);for(let Vn=0;Vn<Fe;Vn++)ki?U.framebufferTextureLayer(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,xt.__webglTexture,Z,St+Vn):U.framebufferTexture2D(U.READ_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,xt.__webglTexture,Z),rs?U.framebufferTextureLayer(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,on.__webglTexture,Ce,nn+Vn):U.framebufferTexture2D(U.DRAW_FRAMEBUFFER,U.COLOR_ATTACHMENT0,U.TEXTURE_2D,on.__webglTexture,Ce),Z!==0?U.blitFramebuffer(Ze,ut,Ze+Ue,ut+Pe,Ye,Mt,Ye+Ue,Mt+Pe,U.COLOR_BUFFER_BIT,U.NEAREST):rs?U.copyTexSubImage3D(Ve,Ce,Ye,Mt,nn+Vn,Ze,ut,Ue,Pe):U.copyTexSubImage2D(Ve,Ce,Ye,Mt,Ze,ut,Ue,Pe);we.bindFramebuffer(U.READ_FRAMEBUFFER,null),we.bindFramebuffer(U.DRAW_FRAMEBUFFER,null)}else rs?w.isDataTexture||w.isData3DTexture?U.texSubImage3D(Ve,Ce,Ye,Mt,nn,Ue,Pe,Fe,kt,_n,Bt.data):B.isCompressedArrayTexture?U.compressedTexSubImage3D(Ve,Ce,Ye,Mt,nn,Ue,Pe,Fe,kt,Bt.data):U.texSubImage3D(Ve,Ce,Ye,Mt,nn,Ue,Pe,Fe,kt,_n,Bt):w.isDataTexture?U.texSubImage2D(U.TEXTURE_2D,Ce,Ye,Mt,Ue,Pe,kt,_n,Bt.data):w.isCompressedTexture?U.compressedTexSubImage2D(U.TEXTURE_2D,Ce,Ye,Mt,Bt.width,Bt.height,kt,Bt.data):U.texSubImage2D(U.TEXTURE_2D,Ce,Ye,Mt,Ue,Pe,kt,_n,Bt);we.pixelStorei(U.UNPACK_ROW_LENGTH,un),we.pixelStorei(U.UNPACK_IMAGE_HEIGHT,Et),we.pixelStorei(U.UNPACK_SKIP_PIXELS,ss),we.pixelStorei(U.UNPACK_SKIP_ROWS,dn),we.pixelStorei(U.UNPACK_SKIP_IMAGES,Rr),Ce===0&&B.generateMipmaps===!0&&B.mipmapsAutoUpdate===!0&&U.generateMipmap(Ve),we.unbindTexture()},this.initRenderTarget=function(w){$e.get(w).__webglFramebuffer===void 0&&je.setupRenderTarget(w)},this.initTexture=function(w){w.isCubeTexture?je.setTextureCube(w,0):w.isData3DTexture?je.setTexture3D(w,0):w.isDataArrayTexture||w.isCompressedArrayTexture?je.setTexture2DArray(w,0):je.setTexture2D(w,0),we.unbindTexture()},this.resetState=function(){Y=0,z=0,ce=null,we.reset(),Ae.reset()},typeof __THREE_DEVTOOLS__<"u"&&__THREE_DEVTOOLS__.dispatchEvent(new CustomEvent("observe",{detail:this}))}get coordinateSystem(){return gi}get outputColorSpace(){return this._outputColorSpace}set outputColorSpace(e){this._outputColorSpace=e;let t=this.getContext();t.drawingBufferColorSpace=Tt._getDrawingBufferColorSpace(e),t.unpackColorSpace=Tt._getUnpackColorSpace()}};var jd=class{solid=new Aa({vertexColors:!0});lit=new Ai({vertexColors:!0});hollow=new Ai({transparent:!0,opacity:.12,depthWrite:!1});hollowEdge=new Ri;edge=new Ri;grid=new Ri;north=new Ai({side:ci});letter=new Ai({depthTest:!1,transparent:!0});needle=new Ri;wedge=new Ai({transparent:!0,opacity:.16,depthWrite:!1,side:ci});axes=new Ri({vertexColors:!0,depthTest:!1,transparent:!0});letters=new Map;ghosts=new Map;refresh(){this.hollow.color.set(jt("--warn")),this.hollowEdge.color.set(jt("--warn")),this.edge.color.set(jt("--body-edge")),this.solid.color.set(jt("--body")),this.lit.color.set(jt("--body")),this.grid.color.set(jt("--grid")),this.north.color.set(jt("--north")),this.letter.color.set(jt("--north")),this.needle.color.set(jt("--accent")),this.wedge.color.set(jt("--accent"));for(let[e,t]of this.letters)t.map?.dispose(),t.map=Cg(e,jt(e==="N"?"--north":"--muted"));for(let[e,{face:t,edge:n}]of this.ghosts)t.color.set(jt(`--m${e}`)),n.color.set(jt(`--m${e}`))}ghost(e){let t=this.ghosts.get(e);if(!t){let n=jt(`--m${e}`);t={face:new Ai({color:n,transparent:!0,opacity:.14,depthWrite:!1}),edge:new Ri({color:n,transparent:!0,opacity:.85})},this.ghosts.set(e,t)}return t}sign(e){let t=this.letters.get(e);return t||(t=new oo({map:Cg(e,jt(e==="N"?"--north":"--muted")),depthWrite:!1,depthTest:!1}),this.letters.set(e,t)),t}};function Cg(i,e){let t=document.createElement("canvas");t.width=t.height=64;let n=t.getContext("2d");return n.fillStyle=e,n.font="600 44px system-ui, sans-serif",n.textAlign="center",n.textBaseline="middle",n.fillText(i,32,34),new ma(t)}var Wt=new jd;function Ig(i,e=!1){let t=i[0].index!==null,n=new Set(Object.keys(i[0].attributes)),s=new Set(Object.keys(i[0].morphAttributes)),r={},o={},a=i[0].morphTargetsRelative,l=new Jt;l.morphTargetsRelative=a;let c=0;for(let h=0;h<i.length;++h){let d=i[h],u=0,f=0;if(t!==(d.index!==null))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". All geometries must have compatible attributes; make sure index attribute exists among all geometries, or in none of them."),null;for(let p in d.attributes){if(!n.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have compatible attributes; make sure "'+p+'" attribute exists among all geometries, or in none of them.'),null;r[p]===void 0&&(r[p]=[]),r[p].push(d.attributes[p]),u++}if(u!==n.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of attributes."),null;if(a!==d.morphTargetsRelative)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". .morphTargetsRelative must be consistent throughout all geometries."),null;for(let p in d.morphAttributes){if(!s.has(p))return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+".  .morphAttributes must be consistent throughout all geometries."),null;if(d.morphAttributes[p].length!==i[0].morphAttributes[p].length)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+'. All geometries must have the same number of morph targets for the "'+p+'" morph attribute.'),null;o[p]===void 0&&(o[p]=[]),o[p].push(d.morphAttributes[p]),f++}if(f!==s.size)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". Make sure all geometries have the same number of morph attributes."),null;if(e){let p;if(t)p=d.index.count;else if(d.attributes.position!==void 0)p=d.attributes.position.count;else return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed with geometry at index "+h+". The geometry must have either an index or a position attribute"),null;l.addGroup(c,p,h),c+=p}}if(t){let h=0,d=[];for(let u=0;u<i.length;++u){let f=i[u].index;for(let p=0;p<f.count;++p)d.push(f.getX(p)+h);h+=i[u].attributes.position.count}l.setIndex(d)}for(let h in r){let d=Pg(r[h]);if(!d)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" attribute."),null;l.setAttribute(h,d)}for(let h in o){let d=o[h][0].length;if(d!==0){l.morphAttributes=l.morphAttributes||{},l.morphAttributes[h]=[];for(let u=0;u<d;++u){let f=[];for(let x=0;x<o[h].length;++x)f.push(o[h][x][u]);let p=Pg(f);if(!p)return console.error("THREE.BufferGeometryUtils: .mergeGeometries() failed while trying to merge the "+h+" morphAttribute."),null;l.morphAttributes[h].push(p)}}}return l}function Pg(i){let e,t,n,s=-1,r=0;for(let c=0;c<i.length;++c){let h=i[c];if(e===void 0&&(e=h.array.constructor),e!==h.array.constructor)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.array must be of consistent array types across matching attributes."),null;if(t===void 0&&(t=h.itemSize),t!==h.itemSize)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.itemSize must be consistent across matching attributes."),null;if(n===void 0&&(n=h.normalized),n!==h.normalized)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.normalized must be consistent across matching attributes."),null;if(s===-1&&(s=h.gpuType),s!==h.gpuType)return console.error("THREE.BufferGeometryUtils: .mergeAttributes() failed. BufferAttribute.gpuType must be consistent across matching attributes."),null;r+=h.count*t}let o=new e(r),a=new Un(o,t,n),l=0;for(let c=0;c<i.length;++c){let h=i[c];if(h.isInterleavedBufferAttribute){let d=l/t;for(let u=0,f=h.count;u<f;u++)for(let p=0;p<t;p++){let x=h.getComponent(u,p);a.setComponent(u+d,p,x)}}else o.set(h.array,l);l+=h.count*t}return s!==void 0&&(a.gpuType=s),a}var Ug=!0,ef=(i,e)=>Ug?e:i;function Ws(i,e,t,n,s){return{geometry:new Os(i,e,t).translate(...n).toNonIndexed(),tone:s}}function Xs(i,e,t,n,s,r=i){let o=new lo(r,i,e,ef(8,28));return t==="x"&&o.rotateZ(-Math.PI/2),t==="z"&&o.rotateX(Math.PI/2),{geometry:o.translate(...n).toNonIndexed(),tone:s}}function Lg(i,e,t,n,s){let r=new ar().absarc(0,0,i,0,2*Math.PI,!1);r.holes.push(new or().absarc(0,0,e,0,2*Math.PI,!0));let o=new fo(r,{depth:t,bevelEnabled:!1,curveSegments:ef(8,24)});return o.translate(0,0,-t/2).rotateX(Math.PI/2).translate(...n),{geometry:o.index?o.toNonIndexed():o,tone:s}}function Mh(i,e,t,n,s,r){let[o,a,l]=[i/2,e/2,n],c=new ar;c.absarc(o-l,a-l,l,0,Math.PI/2,!1),c.absarc(-o+l,a-l,l,Math.PI/2,Math.PI,!1),c.absarc(-o+l,-a+l,l,Math.PI,1.5*Math.PI,!1),c.absarc(o-l,-a+l,l,1.5*Math.PI,2*Math.PI,!1);let h=new fo(c,{depth:t,bevelEnabled:!1,curveSegments:ef(1,6)});return h.translate(s[0],s[1],s[2]-t/2),{geometry:h.index?h.toNonIndexed():h,tone:r}}var qa=(i,e,t=.16)=>({geometry:new co(t,1.5*t,3).rotateY(Math.PI).scale(1,1,.3).translate(0,i,e).toNonIndexed(),tone:2}),Dg={board:()=>[Mh(1.3,1.9,.12,.14,[0,0,0],0),Ws(.5,.5,.12,[0,.05,.12],1),Ws(.34,.2,.12,[0,-.86,.1],1),Ws(.12,.26,.08,[-.42,.3,.1],1),Ws(.12,.26,.08,[.42,.3,.1],1),qa(.68,.09,.15)],phone:()=>[Mh(1,2.1,.14,.16,[0,0,0],0),Mh(.92,2,.02,.12,[0,0,.08],1),qa(.7,.1,.14)],band:()=>[Xs(.3,2.3,"y",[0,-.05,0],3,.26),Lg(.46,.36,.55,[0,0,0],0),Mh(.62,.7,.2,.1,[0,0,.48],1),qa(.16,.59,.13)],handle:()=>[Xs(.24,1.9,"y",[0,-.2,0],0,.21),Lg(.3,.2,.12,[0,.72,0],1),Xs(.2,.4,"y",[0,.95,0],1,.1),Ws(.16,.4,.1,[0,.2,.22],1),qa(.52,.24,.11)],robot:()=>[Ws(.9,.5,.5,[0,0,-.55],1),Ws(.72,.36,1.25,[0,0,.3],0),Ws(.9,.46,.26,[0,0,.98],1),Xs(.5,.2,"x",[-.62,0,-.7],3),Xs(.5,.2,"x",[.62,0,-.7],3),{geometry:new co(.15,.3,3).rotateY(Math.PI).translate(0,.36,.98).toNonIndexed(),tone:2}],joint:()=>[Xs(.2,1.1,"y",[0,.6,0],0,.16),Xs(.3,.44,"x",[0,0,0],1),Xs(.17,.36,"y",[0,-.4,0],3),qa(1.2,0,.14)]},zb=[.93,.42,-1,.62],Hb=new pt(4025842),Ng=new Map;function bh(i,e){let t=`${i} ${e}`,n=Ng.get(t);if(!n){Ug=e;let s=(Dg[i]??Dg.board)().map(({geometry:o,tone:a})=>{let l=o.getAttribute("position").count,c=zb[a],h=c<0?Hb:new pt().setRGB(c,c,c,$n),d=new Float32Array(3*l);for(let u=0;u<l;u++)h.toArray(d,3*u);return o.setAttribute("color",new Un(d,3)),o.deleteAttribute("uv"),o}),r=Ig(s);n={solid:r,edges:new va(r,35)},Ng.set(t,n)}return n}var Ah=-1.35,yn=1.9,tf=.42,nf=.5,Hn={sun:1.9,from:new X(-1.5,-2.5,4),around:1.7,sky:new pt(16777215),earth:new pt(8949920)},wh=24,Gb=[["N",0,1],["E",1,0],["S",0,-1],["W",-1,0]],Vb=[["y",0,1],["x",1,0]];function Fg(i,e){let t=[],n=(s,r)=>[r*Math.sin(2*Math.PI*s),r*Math.cos(2*Math.PI*s),0];for(let s=0;s<i;s++)t.push(...n(s/i,yn),...n((s+1)/i,yn));for(let s=0;s<e;s++)t.push(...n(s/e,yn-(s%9===0?.22:.1)),...n(s/e,yn));return t.push(-.9*yn,0,0,.9*yn,0,0,0,-.9*yn,0,0,.9*yn,0),new Jt().setAttribute("position",new Lt(t,3))}function Wb(){let[i,e]=[yn+.02,yn-.3],t=[0,i,.01,-.13,e,.01,.13,e,.01];return new Jt().setAttribute("position",new Lt(t,3))}function Xb(){let i=[0,0,0,1.25,0,0,0,0,0,0,1.55,0,0,0,0,0,0,1.1],e=["--x","--y","--z"].flatMap(t=>{let[n,s,r]=new pt(jt(t)).toArray();return[n,s,r,n,s,r]});return new Jt().setAttribute("position",new Lt(i,3)).setAttribute("color",new Lt(e,3))}var Ya={rose:Fg(72,36),plain:Fg(28,0),north:Wb()},Eh=class{constructor(e,t){this.ghost=t;let{solid:n,edges:s}=bh(e,!0);this.face=new kn(n,Wt.solid),this.edge=new ms(s,Wt.edge),this.group.add(this.face,this.edge),this.setValid(!0)}ghost;group=new Yi;sequence=-1;valid=!0;face;edge;setValid(e){this.valid=e;let t=this.ghost===null?null:Wt.ghost(this.ghost);this.face.material=t?t.face:e?Wt.solid:Wt.hollow,this.edge.material=t?t.edge:e?Wt.edge:Wt.hollowEdge}};function sf(i){if(!i?.valid)return null;let[e,t,n,s]=i.quat,[r,o]=[2*(t*n-e*s),1-2*(t*t+s*s)];return Math.hypot(r,o)>.2?Math.atan2(r,o):null}function qb(){let i=new La(16777215,Hn.sun);i.position.copy(Hn.from);let e=new Pa(Hn.sky,Hn.earth,Hn.around);return e.position.set(0,0,1),[e,i]}function rf(i,e,t,n){let s=8.4/Math.min(1,Math.max(.5,n)),r=Math.cos(t);i.up.set(0,0,1),i.position.set(Math.sin(e)*r,-Math.cos(e)*r,Math.sin(t)).multiplyScalar(s),i.position.z-=.5,i.lookAt(0,0,-.5),i.aspect=n,i.updateProjectionMatrix()}var Th=class{constructor(e){this.shape=e;this.scene.add(...qb());let t=new Yi;t.position.z=Ah,t.add(new ms(Ya.rose,Wt.grid));let n=e==="joint";n||t.add(new kn(Ya.north,Wt.north));for(let[r,o,a]of n?Vb:Gb){let l=new da(Wt.sign(r));l.position.set(o*(yn+.3),a*(yn+.3),0),l.scale.setScalar(.44),l.renderOrder=3,t.add(l)}this.needle=new ao(new Jt().setAttribute("position",new Lt([0,0,.01,0,0,.01],3)),Wt.needle),this.needle.frustumCulled=!1,t.add(this.needle);let s=new Jt().setAttribute("position",new Lt(new Float32Array(3*(wh+2)),3));s.setIndex(Array.from({length:wh},(r,o)=>[0,o+1,o+2]).flat()),this.wedge=new kn(s,Wt.wedge),this.wedge.frustumCulled=!1,t.add(this.wedge),this.scene.add(t),this.rebuild([])}shape;scene=new sr;camera=new Nn(30,1,.5,40);azimuth=tf;elevation=nf;bodies=[];needle;wedge;ghosts="";rebuild(e){for(let n of this.bodies)this.scene.remove(n.group);this.bodies=[new Eh(this.shape,null),...e.slice(1).map(n=>new Eh(this.shape,n.colour))];let t=new ms(Xb(),Wt.axes);t.renderOrder=2,this.bodies[0].group.add(t);for(let n of this.bodies)this.scene.add(n.group)}pose(e){let t=e.slice(1).map(n=>n.colour).join();t!==this.ghosts&&(this.ghosts=t,this.rebuild(e)),this.bodies.forEach((n,s)=>{let r=e[s],o=r!==void 0&&r.quat.every(Number.isFinite);n.group.visible=o||s===0,o&&n.group.quaternion.set(r.quat[1],r.quat[2],r.quat[3],r.quat[0]),n.sequence=r?.sequence??-1,n.setValid(o&&r.valid)}),this.point(e[0])}point(e){let t=sf(e);if(this.needle.visible=t!==null,this.wedge.visible=t!==null&&e.sigmaHeading>.002,t===null)return;let n=this.needle.geometry.getAttribute("position");if(n.setXYZ(1,yn*Math.sin(t),yn*Math.cos(t),.01),n.needsUpdate=!0,!this.wedge.visible)return;let s=this.wedge.geometry.getAttribute("position"),r=Math.min(Math.PI,e.sigmaHeading);for(let o=0;o<=wh;o++){let a=t+r*(2*o/wh-1);s.setXYZ(o+1,yn*Math.sin(a),yn*Math.cos(a),.005)}s.needsUpdate=!0}drawn(e=0){let t=this.bodies[e];if(!t)return null;let{x:n,y:s,z:r,w:o}=t.group.quaternion;return{quat:[o,n,s,r],sequence:t.sequence,valid:t.valid}}look(e){rf(this.camera,this.azimuth,this.elevation,e)}};function of(i,e,t,n){let{ring:s}=e,r=n?s.length-1:s.find(t);return r<0?{quat:[NaN,NaN,NaN,NaN],sequence:-1,valid:!1,sigmaHeading:NaN,colour:e.colour}:{quat:[0,1,2,3].map(o=>s.value(r,Ct.quat+o)),sequence:s.sequence(r),valid:!i.whyInvalid(e,r)||!n&&s.valid(r),sigmaHeading:s.value(r,Ct.sigma+2),colour:e.colour}}var Rh=class{constructor(e,t,n,s,r){this.store=e;this.playhead=t;this.id=n;this.element=s;this.scene=new Th(r),this.turnable()}store;playhead;id;element;scene;get elements(){return[this.element]}update(){let e=this.store.tracksOf(this.id).filter(t=>t.running);this.scene.pose(e.map(t=>of(this.store,t,this.playhead.time,this.playhead.following)))}draw(e,t,{left:n,top:s,height:r}){let o=t.get(this.element);if(!o)return;let[a,l]=[o.left-n,o.top-s],[c,h]=[Math.max(0,l),Math.min(r,l+o.height)];h<=c||(this.scene.look(o.width/o.height),e.setViewport(a,r-l-o.height,o.width,o.height),e.setScissor(a,r-h,o.width,h-c),e.render(this.scene.scene,this.scene.camera))}turnable(){let{element:e,scene:t}=this,n=(s,r)=>{t.azimuth+=s,t.elevation=Math.min(1.5,Math.max(.05,t.elevation+r)),this.store.version++};e.addEventListener("pointerdown",s=>e.setPointerCapture(s.pointerId)),e.addEventListener("pointermove",s=>{e.hasPointerCapture(s.pointerId)&&n(-.008*s.movementX,.008*s.movementY)}),e.addEventListener("keydown",s=>{let r={ArrowLeft:[.1,0],ArrowRight:[-.1,0],ArrowUp:[0,.1],ArrowDown:[0,-.1]}[s.key];r&&(s.preventDefault(),n(r[0],r[1]))})}};function mr(i){return i===null?"":ll[i]??""}var $a={true:"0\xB0 is true north",magnetic:"0\xB0 is magnetic north",arbitrary:"0\xB0 is where it started: no magnetometer, or set by hand"},Ch={waiting:"waiting for samples",starting:"loading its method",live:"live",silent:"silent",standing:"clock stands still",failed:"ended by a fault"},Bg={standing:"its samples come, but the clock in them stands still: the attitude now is unknown",failed:"its run has ended by a fault: the attitude now is unknown"},Og={waiting:"Nothing has come from it yet. See that it is switched on, and that it sends to this server.",starting:"Its samples wait until the method is loaded, which takes longest the first time.",live:"",silent:"See to its power, its cable or radio, and to what sends for it. It goes on by itself with the next sample.",standing:"See to what stamps its samples, or start the device anew. It goes on by itself once its clock does.",failed:"Nothing more is taken from it until it begins anew: under Methods choose another, or press Apply in its parameters. The fault is poise\u2019s: please report it."};function kg({state:i,failed:e},t){return t?i==="live"?"":i==="waiting"?"It begins once both of its devices send.":"One of its two devices is not live: its own page says why.":e?`${e.replace(/[.\s]*$/,"")}. ${Og.failed}`:Og[i]}function af(i){return i.map(e=>`\u201C${e}\u201D`).join(", ")}function Di(i){return Number.isFinite(i)?Math.round(i).toLocaleString("en").replaceAll(","," "):"\u2013"}var Yb=200;function gr(i){return`#/${encodeURIComponent(i)}`}var So=class{constructor(e,t,n,s){this.store=e;this.playhead=t;this.stage=n;this.crowd=s;n.add(this.crowd),this.sync()}store;playhead;stage;crowd;element=F("div",{class:"grid",role:"list","aria-label":"Devices"});tiles=new Map;written=0;visible=new Set;watcher=new IntersectionObserver(e=>{for(let{target:t,isIntersecting:n}of e){let s=[...this.tiles.values()].find(r=>r.element===t);n?this.visible.add(t):this.visible.delete(t),s&&(n?this.crowd.add(s.body,s.device.shape,()=>this.pose(s)):this.crowd.remove(s.body),this.stage.dirty=!0)}},{rootMargin:"80px"});destroy(){this.watcher.disconnect(),this.stage.remove(this.crowd),this.crowd.clear()}sync(){let e=[...this.store.devices.values()].sort((t,n)=>t.id.localeCompare(n.id,"en",{numeric:!0}));this.element.classList.toggle("many",e.length>8);for(let[t,n]of this.tiles)this.store.devices.get(t)?.shape!==n.device.shape&&(this.watcher.unobserve(n.element),this.crowd.remove(n.body),n.element.parentElement?.remove(),this.tiles.delete(t));e.forEach((t,n)=>{this.tiles.has(t.id)||this.tiles.set(t.id,this.tile(t));let s=this.tiles.get(t.id).element.parentElement;this.element.children[n]!==s&&this.element.insertBefore(s,this.element.children[n]??null)})}tile(e){let t=F("div",{class:"body"}),[n,s,r]=[F("b"),F("b"),F("span",{class:"chip"})],o=e.shape==="joint"?["Angle","Turn"]:["Heading","Tilt"],a=F("a",{class:"tile",href:gr(e.id)},t,F("div",{class:"name"},e.id),F("dl",{},...o.map((l,c)=>F("div",{},F("dt",{},l),F("dd",{},[n,s][c],"\xB0")))),r);return F("div",{role:"listitem"},a),this.watcher.observe(a),{element:a,body:t,device:e,first:n,second:s,state:r}}pose({device:e}){let t=this.store.tracksOf(e.id).find(n=>n.running);return t&&of(this.store,t,this.playhead.time,this.playhead.following)}drawn(e){let t=this.tiles.get(e);return t?this.crowd.drawn(t.body):null}update(e){if(!(e-this.written<Yb)){this.written=e;for(let[t,n]of this.tiles)this.visible.has(n.element)&&this.write(t,n)}}write(e,t){let n=this.store.mainTrack(e),s=this.playhead.following,r=n?s?n.ring.length-1:n.ring.find(this.playhead.time):-1,o=n?s?this.store.whyInvalid(n,r):r<0||!n.ring.valid(r)?"not valid":"":"no method",a=this.store.tipOf(e),l=n&&r>=0?Qs(n.ring,r):null,c=t.device.shape==="joint",[h,d]=l?c?[l.angle,l.turn]:[l.heading,l.tilt]:[NaN,NaN];et(t.first,en(h,0)),et(t.second,en(d,0));let u=a!==null&&Rs.has(a),f=this.store.conditions.get(e)?.state??"waiting",p=u?mr(a):o?f==="live"?"not valid":Ch[f]:a!==null?mr(a):"valid";et(t.state,p),t.element.classList.toggle("alarming",u),t.element.classList.toggle("invalid",!u&&o!==""),t.element.title=o,t.element.setAttribute("aria-label",`${e}: ${p}${l?`, ${c?"angle":"heading"} ${en(h,0)} degrees, ${c?"turn":"tilt"} ${en(d,0)} degrees`:""}`)}};var lf=3,$b=3,Ph=class{constructor(e){this.store=e}store;element=Rn("alarm");shown="";update(){let e=[...this.store.devices.keys()].filter(n=>Rs.has(this.store.tipOf(n)??255)),t=this.store.link.state+e.map(n=>`${n} ${this.store.tipOf(n)} ${this.last(n)?.number}`).join("|");t!==this.shown&&(this.shown=t,this.element.replaceChildren(...e.slice(0,lf).map(n=>this.row(n))),e.length>lf&&this.element.append(F("p",{},`and ${e.length-lf} more`)),document.body.classList.toggle("alarmed",e.length>0))}last(e){return this.store.events.findLast(t=>t.kind==="tip"&&t.device===e)}row(e){let t=this.store.tipOf(e),n=this.last(e),s=n?.state===["UNKNOWN","UPRIGHT","LEANING","TIPPING","FALLEN","FREE_FALL"][t]?n:void 0,r=[typeof s?.tilt_deg=="number"?`tilt ${s.tilt_deg.toFixed(0)}\xB0`:"",t===$b&&typeof s?.impact_s=="number"?`hits the ground in ${s.impact_s.toFixed(1)} s unless caught`:""].filter(Boolean),o=`${this.store.link.state==="open"?"":"was "}${mr(t)}`;return F("p",{},F("strong",{},`${o[0].toUpperCase()}${o.slice(1)}${s?.direction?` ${s.direction}`:""}`),F("a",{href:gr(e)},e),F("span",{},r.join(" \xB7 ")))}},Ih=class{constructor(e){this.store=e}store;element=Rn("banner");update(){let{link:e}=this.store,t=e.state==="lost";if(document.body.classList.toggle("lost",t||e.state==="connecting"&&document.body.classList.contains("lost")),!t){e.state==="open"&&et(this.element,"");return}let n=Math.max(0,Math.ceil((e.retryAt-Date.now())/1e3)),s=Math.round((Date.now()-e.since)/1e3);et(this.element,`Connection lost ${s} s ago: what is shown is the last that came. ${n?`Trying again in ${n} s.`:"Trying again \u2026"}`)}};var Lh=class{constructor(e,t,n,s){this.store=e;this.chosen=s;this.phone=F("button",{id:"phone",hidden:!0,onclick:()=>{t.open()}},F("span",{class:"wide"},"Use a "),"phone"),this.download=F("button",{id:"download",onclick:()=>{n.open(this.chosen())}},"Download"),Rn("bar").append(F("a",{class:"mark",href:"#/","aria-label":"poise, all devices"},"poise"),this.crumb,this.recording,this.state,this.phone,this.download)}store;chosen;crumb=F("nav",{"aria-label":"Where you are"});state=F("span",{class:"link"});recording=F("span",{class:"recording"});phone;download;shown;update(){let{link:e,hello:t,devices:n,health:s}=this.store,r=this.chosen(),o=n.size>1,a=[...n.values()].filter(f=>f.shape==="joint").length,l=(f,p)=>`${f} ${p}${f===1?"":"s"}`,c=l(n.size-a,this.store.instant?"recording":"device")+(a?`, ${l(a,"joint")}`:""),h=`${r} ${c}`;h!==this.shown&&(this.shown=h,this.crumb.replaceChildren(...o?[r?F("a",{class:"back",href:"#/","aria-label":c},F("span",{class:"wide"},c)):F("span",{},c)]:[],...r?[F("h1",{},r)]:[]),document.title=r?`${r} \u2013 poise`:"poise",this.download.hidden=n.size===0||this.store.instant!==null);let d={connecting:"Connecting",open:"Live",lost:"Connection lost",refused:"Token needed"};et(this.state,this.store.instant&&e.state==="open"?"From file":d[e.state]),this.state.dataset.state=e.state,this.state.title=t?.server??"";let u=s?.recording??t?.recording??null;et(this.recording,u&&e.state==="open"?u.reason?"Not recording":"Recording":""),this.recording.classList.toggle("bad",!!u?.reason),this.recording.title=u?.reason??"",this.phone.hidden=!t?.offers?.includes("/phone")}};var zg=[0,0,0,1],cf=Hn.from.clone().normalize(),hf=new Ft,Zb=new Ft,Jb=new _i,es=class{constructor(e,t,n){this.kind=n;this.object=n==="lines"?new ms(void 0,t):new kn(void 0,t),this.object.frustumCulled=!1;let s=r=>e.getAttribute(r).array;this.points=s("position"),this.normals=n==="lit"?s("normal"):null,this.colours=n==="lit"?s("color"):null}kind;object;points;normals;colours;room=0;length=0;at;shade;empty(){this.length=0}put(e,t,n){let{points:s,kind:r}=this,o=s.length/3;this.length+o>this.room&&this.grow(2*(this.length+o)),hf.makeRotationFromQuaternion(Jb.set(...e));let a=Zb.multiplyMatrices(n.projectionMatrix,n.matrixWorldInverse).multiply(hf).elements,l=this.at.array,c=r==="lines"?2:3;for(let h=0;h<o;h+=c){let d=3*this.length;for(let u=h;u<h+c;u++,d+=3){let[f,p,x]=[s[3*u],s[3*u+1],s[3*u+2]],m=a[3]*f+a[7]*p+a[11]*x+a[15];l[d]=t.x+t.width*(a[0]*f+a[4]*p+a[8]*x+a[12])/m,l[d+1]=t.y+t.height*(a[1]*f+a[5]*p+a[9]*x+a[13])/m,l[d+2]=-(a[2]*f+a[6]*p+a[10]*x+a[14])/m}c===3&&!Kb(l,d-9)||(this.colours&&this.light(h),this.length+=c)}}light(e){let t=hf.elements,[n,s,r]=[this.normals,this.colours,this.shade.array];for(let o=0;o<3;o++){let[a,l]=[3*(e+o),3*(this.length+o)],[c,h,d]=[n[a],n[a+1],n[a+2]],[u,f,p]=[t[0]*c+t[4]*h+t[8]*d,t[1]*c+t[5]*h+t[9]*d,t[2]*c+t[6]*h+t[10]*d],x=Hn.sun*Math.max(0,u*cf.x+f*cf.y+p*cf.z),[m,g]=[Hn.around*(1+p)/2,Hn.around*(1-p)/2];r[l]=s[a]*(x+m*Hn.sky.r+g*Hn.earth.r)/Math.PI,r[l+1]=s[a+1]*(x+m*Hn.sky.g+g*Hn.earth.g)/Math.PI,r[l+2]=s[a+2]*(x+m*Hn.sky.b+g*Hn.earth.b)/Math.PI}}finish(){this.object.visible=this.length>0,this.object.geometry.setDrawRange(0,this.length);for(let e of this.colours?[this.at,this.shade]:[this.at])e.clearUpdateRanges(),e.addUpdateRange(0,3*this.length),e.needsUpdate=!0}grow(e){this.room=e;let t=new Jt,n=(s,r)=>{let o=new Un(new Float32Array(3*e),3).setUsage(Id);return r&&o.set(r.array),t.setAttribute(s,o),o};this.at=n("position",this.at),this.colours&&(this.shade=n("color",this.shade)),this.object.geometry.dispose(),this.object.geometry=t}};function Kb(i,e){let[t,n]=[i[e],i[e+1]];return(i[e+3]-t)*(i[e+7]-n)>(i[e+6]-t)*(i[e+4]-n)}var Hg=({shown:i})=>!!(i?.valid&&i.quat.every(Number.isFinite)),Dh=class{scene=new sr;canvas=new cr(-1,1,1,-1,-1,1);eye=new Nn(30,1,.5,40);members=new Map;parts=new Map;constructor(){rf(this.eye,tf,nf,1),this.eye.updateMatrixWorld()}get elements(){return this.members.keys()}add(e,t,n){this.members.set(e,{shape:t,pose:n,quat:zg,shown:void 0})}remove(e){this.members.delete(e)}clear(){this.members.clear()}update(){for(let e of this.members.values()){let t=e.shown=e.pose();if(!t?.quat.every(Number.isFinite))continue;let[n,s,r,o]=t.quat;e.quat=[s,r,o,n]}}drawn(e){let t=this.members.get(e);if(!t)return null;let[n,s,r,o]=t.quat;return{quat:[o,n,s,r],sequence:t.shown?.sequence??-1,valid:Hg(t)}}draw(e,t,n){for(let s of this.parts.values())s.empty();for(let[s,r]of this.members){let o=t.get(s);o&&this.put(r,Qb(o,n))}for(let s of this.parts.values())s.finish();e.setViewport(0,0,n.width,n.height),e.setScissor(0,0,n.width,n.height),e.render(this.scene,this.canvas)}put(e,t){let{shape:n,quat:s,shown:r}=e,o=(h,d,u=zg)=>{let f=this.parts.get(h);f||(this.parts.set(h,f=d()),this.scene.add(f.object)),f.put(u,t,this.eye)};o("rose",()=>new es(uf(Ya.plain),Wt.grid,"lines")),n!=="joint"&&(o("mark",()=>new es(uf(Ya.north),Wt.north,"flat")),o("letter",()=>new es(ew(this.eye.quaternion),Wt.letter,"flat")));let a=sf(r);a!==null&&o("needle",()=>new es(jb(),Wt.needle,"lines"),[0,0,Math.sin(-a/2),Math.cos(a/2)]);let{solid:l,edges:c}=bh(n,!1);Hg(e)?(o(`${n} face`,()=>new es(l,Wt.lit,"lit"),s),o(`${n} edge`,()=>new es(c,Wt.edge,"lines"),s)):(o(`${n} hollow face`,()=>new es(l,Wt.hollow,"flat"),s),o(`${n} hollow edge`,()=>new es(c,Wt.hollowEdge,"lines"),s))}};function Qb(i,e){let t=Math.min(i.width,i.height),[n,s]=[i.left+i.width/2-e.left,i.top+i.height/2-e.top];return{x:2*n/e.width-1,y:1-2*s/e.height,width:t/e.width,height:t/e.height}}var uf=i=>i.clone().translate(0,0,Ah);function jb(){return uf(new Jt().setAttribute("position",new Lt([0,0,.03,0,yn,.03],3)))}function ew(i){let[e,t,n]=[.16,.22,.1],s=(...[a,l,c,h])=>[a,l,c,a,c,h].flatMap(([d,u])=>[d,u,0]),r=[...s([-e,-t],[n-e,-t],[n-e,t],[-e,t]),...s([e-n,-t],[e,-t],[e,t],[e-n,t]),...s([e-n,-t],[e,-t],[n-e,t],[-e,t])];return new Jt().setAttribute("position",new Lt(r,3)).applyQuaternion(i).translate(0,yn+.3,Ah)}var tw=40,Gg=500,nw=new Intl.DateTimeFormat("en-GB",{timeStyle:"medium"}),Mo=class{constructor(e,t){this.store=e;this.id=t;this.element=F("section",{class:"panel","aria-label":"Events"},F("h2",{},"Events"),this.list),this.update(0)}store;id;element;list=F("ol",{class:"events"});newest=-1;written=-Gg;update(e){if(e-this.written<Gg)return;this.written=e;let t=this.store.events.filter(s=>this.id===null||s.device===this.id||s.device===null).slice(-tw),n=t.at(-1)?.time??0;n!==this.newest&&(this.newest=n,this.list.replaceChildren(...t.reverse().map(iw)),t.length||this.list.append(F("li",{class:"none"},"Nothing of late")))}};function iw(i){let e=new Date(1e3*i.time),t=i.kind==="tip"&&["TIPPING","FALLEN","FREE_FALL"].includes(i.state??"");return F("li",{class:t?"bad":""},F("time",{datetime:e.toISOString()},nw.format(e)),F("span",{},i.text))}var bo="poise.token";var sw=/^[A-Za-z0-9._~-]+$/;function df(){let i=/^#token=([A-Za-z0-9._~-]+)/.exec(location.hash);return i?(sessionStorage.setItem(bo,i[1]),history.replaceState(null,"",location.pathname+location.search),i[1]):null}async function ff(i){let e=sessionStorage.getItem(bo);return fetch(i,{headers:e?{Authorization:`Bearer ${e}`}:{},cache:"no-store"})}var Nh=class{live=!0;sink;socket=null;wait=.5;lostAt=0;heard=0;asked=0;retry=0;missed=!1;pending=new Map;start(e){this.sink=e,this.connect(),setInterval(()=>this.listen(),1e3)}identify(e){if(!sw.test(e))return this.sink.connection({state:"refused",reason:"A token has letters, digits and . _ ~ - only."});sessionStorage.setItem(bo,e),this.connect()}get(e){return ff(e)}ask(e){let t=`page-${++this.asked}`;return new Promise((n,s)=>{if(this.socket?.readyState!==WebSocket.OPEN)return s(new Error("there is no connection to the server"));this.pending.set(t,{resolve:n,reject:s}),this.socket.send(JSON.stringify({...e,id:t}))})}connect(){clearTimeout(this.retry),this.leave(),this.sink.connection({state:"connecting"});let e=sessionStorage.getItem(bo),t=location.origin.replace(/^http/,"ws")+"/ws/view",n=new WebSocket(t,e?["poise",`bearer.${e}`]:["poise"]);n.binaryType="arraybuffer",this.socket=n,this.heard=performance.now();let s=!1;n.onopen=()=>{s=!0,this.wait=.5,this.lostAt=0,this.sink.connection({state:"open"})},n.onmessage=({data:r})=>{this.socket===n&&(this.heard=performance.now(),r instanceof ArrayBuffer?this.missed=!this.sink.frame(r)||this.missed:this.hear(JSON.parse(r)))},n.onclose=()=>{this.socket===n&&(this.leave(),s?this.again():this.why())}}leave(){let e=this.socket;this.socket=null,e?.close();for(let{reject:t}of this.pending.values())t(new Error("the connection was lost"));this.pending.clear()}hear(e){if(e.type==="done"||e.type==="error"){let t=this.pending.get(e.id??"");this.pending.delete(e.id??""),e.type==="done"?t?.resolve(e):t?.reject(new Error(e.message))}this.sink.message(e),e.type==="devices"&&this.missed&&this.socket?.readyState===WebSocket.OPEN&&(this.missed=!1,this.socket.send(JSON.stringify({type:"subscribe"})))}async why(){try{if((await this.get("/devices")).status===401){let t=sessionStorage.getItem(bo)!==null;return sessionStorage.removeItem(bo),this.sink.connection({state:"refused",reason:t?"That token is not one of this server, or it may not look: the scope \u201Cread\u201D is needed.":""})}}catch{}this.again()}again(){this.lostAt||=Date.now(),this.sink.connection({state:"lost",since:this.lostAt,retryAt:Date.now()+1e3*this.wait}),this.retry=setTimeout(()=>this.connect(),1e3*this.wait),this.wait=Math.min(5,1.6*this.wait)}listen(){this.socket?.readyState===WebSocket.OPEN&&performance.now()-this.heard>1e3*6&&(this.leave(),this.again())}};var pf=8e3,rw=20,qs=class{live=!1;films=new Map;sink;held=new Map;loaded=()=>{};ready=new Promise(e=>this.loaded=e);start(e){this.sink=e,this.load()}get(e){return ff(e)}identify(){this.load()}ask(e){return Promise.reject(new Error("a recording cannot be changed"))}get duration(){return Math.max(.001,...[...this.films.values()].map(e=>e.end-e.start))}async load(){this.sink.connection({state:"connecting"});try{let e=await this.get("/films");if(!e.ok)throw new Error(await e.text());let{server:t,flags:n,invalid_flags:s,films:r}=await e.json();if(!r.length)return location.replace(location.pathname+location.hash);r.forEach((o,a)=>this.films.set(r.findIndex(l=>l.id===o.id)===a?o.id:`${o.id} ${a+1}`,o)),this.sink.connection({state:"open"}),this.sink.message({type:"hello",server:t,flags:n,invalid_flags:s,time:Date.now()/1e3,may_write:!1,methods:[],offers:[],recording:null}),this.sink.message({type:"devices",devices:[...this.films].map(([o,a])=>({...a,id:o,connected:!0}))}),this.loaded(),await Promise.all([...this.films].map(([o,a])=>this.fetch(o,a,0,a.end-a.start)))}catch(e){this.sink.connection({state:"refused",reason:`The recordings cannot be had: ${e.message}`})}}look(e,[t,n],s){let r=this.films.get(e),o=this.held.get(e);if(!r||!o||o.asking)return;let a=r.end-r.start,[l,c]=[Math.max(0,t),Math.min(a,n)],h=rw*Math.max(1,s),[d,u]=[Math.max(0,l-h),Math.min(a,c+h)],f=1/(r.rate_hz??1/0),p=Math.max(f,(u-d)/pf),x=Math.min(a,c+h/4);o.from<=l&&x<=o.to&&o.step<=2*p||this.fetch(e,r,d,u)}async fetch(e,t,n,s){let r={from:n,to:s,step:Math.max(1/(t.rate_hz??1/0),(s-n)/pf),asking:!0};this.held.set(e,{...this.held.get(e)??r,asking:!0});try{let o=await this.get(`/films/${t.number}/frame?start=${t.start+n}&end=${t.start+s}&most=${pf}`);if(!o.ok)throw new Error(await o.text());let a=await o.arrayBuffer();ow(a,t.start),this.sink.cleared(e),this.sink.frame(a),this.held.set(e,{...r,asking:!1})}catch(o){this.sink.connection({state:"lost",since:Date.now(),retryAt:Date.now()}),setTimeout(()=>{this.again(e,t,n,s)},1e3),console.warn(o)}}async again(e,t,n,s){await this.fetch(e,t,n,s),this.held.get(e)?.asking||this.sink.connection({state:"open"})}};function ow(i,e){let t=new DataView(i);for(let n=16+8*Ct.host;n<i.byteLength;n+=120)t.setFloat64(n,t.getFloat64(n,!0)-e,!0)}var gf=200,Uh=class{element;constructor(e,t,n,s){let r=new Map(e.tracksOf(n).map(p=>[p.method.number,p.colour])),o=p=>{let x=F("i",{class:"key"});return x.style.setProperty("--key",`var(--m${r.get(p)??0})`),x},a=s.methods.some(p=>p.error_deg),l=F("tr",{},F("th",{scope:"col"},"Method"),...a?["Total","Heading","Incl."].map(p=>F("th",{scope:"col"},p)):[]),c=s.methods.map(p=>{let x=p.error_deg,m=x?[x.total,x.heading,x.inclination].map(S=>F("td",{},S===null?"\u2013":`${en(S,2)}\xB0`)):a?[F("td",{colspan:3},p.reference?"":"\u2013")]:[],g=F("th",{scope:"row"},o(p.number),p.name);return g.title=p.settings==="{}"?$a[p.heading]:`${p.settings}; ${$a[p.heading]}`,F("tr",{},g,...m)}),h=a?"RMSE against the reference, where it moves":`${Di(s.rows)} rows, ${en(s.end-s.start,1)} s`,d=F("table",{class:"errors"},F("caption",{},h),F("thead",{},l),F("tbody",{},...c)),u=s.methods.flatMap(p=>p.stretches.map(x=>({...x,method:p})));u.sort((p,x)=>p.start-x.start);let f=u.slice(0,gf).map(({method:p,flag:x,start:m,end:g,text:S})=>{let[T,y]=[m-s.start,g-s.start],C=F("button",{class:"stretch",onclick:()=>t.seek(T)},o(p.number),F("b",{},p.reference?"no reference":x.toLowerCase().replaceAll("_"," ")),F("time",{},`${en(T,2)}\u2013${en(y,2)} s`));return C.title=`${p.name}: ${S}`,F("li",{},C)});u.length>gf&&f.push(F("li",{class:"none"},`and ${Di(u.length-gf)} more`)),u.length||f.push(F("li",{class:"none"},"No flags")),this.element=F("div",{class:"filmed"},F("section",{class:"panel","aria-label":"Methods"},F("h2",{},"Methods"),d),F("section",{class:"panel","aria-label":"Flags"},F("h2",{},"Flags"),F("ol",{class:"events stretches"},...f)))}};var aw=["State","Source","Rate","Samples","Lost","Repeated","Refused","Silences","Delay to here","In the server, p99","Clock drift"],lw=["State","Source","Rate","Samples","Delay to here"],Fh=class{constructor(e,t){this.store=e;this.id=t.id,this.values=new Map((t.shape==="joint"?lw:aw).map(s=>[s,F("dd",{},"\u2013")]));let n=[...this.values].map(([s,r])=>F("div",{},F("dt",{},s),r));this.element=F("section",{class:"panel","aria-label":"Link"},F("h2",{},"Link"),F("dl",{class:"facts"},...n))}store;element;values;id;written=0;update(e){if(e-this.written<500)return;this.written=e;let t=this.store.conditions.get(this.id),n=this.store.devices.get(this.id);if(!t||!n)return;let s=t.state==="silent"&&t.last_heard_s!==null?` for ${en(t.last_heard_s,1)} s`:"",r=this.store.delays.get(this.id),o=t.wait_ms?.p99??this.store.health?.wait_ms.p99,a=this.store.link.state==="open";this.set("State",a?Ch[t.state]+s:"not known: connection lost",a&&t.state==="failed"),this.set("Source",n.source),this.set("Rate",`${en(t.rate_hz,1)} Hz`),this.set("Samples",Di(t.samples)),this.set("Lost",Di(t.lost),t.lost>0),this.set("Repeated",Di(t.repeated)),this.set("Refused",Di(t.rejected),t.rejected>0),this.set("Silences",Di(t.silences)),this.set("Delay to here",r===void 0?"\u2013":`${en(Math.max(0,1e3*r),0)} ms`),this.set("In the server, p99",typeof o=="number"?`${en(o,1)} ms`:"\u2013"),this.set("Clock drift",`${en(t.clock_drift_ppm,1)} ppm`)}set(e,t,n=!1){let s=this.values.get(e);s&&(et(s,t),s.classList.toggle("bad",n))}};var cw=8,Oh=class{constructor(e,t,n){this.store=e;this.source=t;this.id=n;this.element=F("section",{class:"panel","aria-label":"Methods"},F("h2",{},"Methods"),this.list,this.answer),this.sync()}store;source;id;element;list=F("div",{class:"methods"});answer=F("p",{class:"answer",role:"status","aria-live":"polite"});shown="";open=new Set;get wanted(){return(this.store.devices.get(this.id)?.methods??[]).map(({name:e,settings:t})=>({name:e,settings:JSON.parse(t)}))}sync(){let e=this.store.devices.get(this.id),{hello:t}=this.store,n=e?.methods.map(({number:a,name:l,settings:c})=>[a,l,c]),s=JSON.stringify([n,t?.may_write,this.store.tracksOf(this.id).map(a=>a.colour)]);if(s===this.shown||!e||!t)return;this.shown=s;let r=document.activeElement?.id,o=this.adding(t.methods,e);this.list.replaceChildren(...e.methods.map((a,l)=>this.row(e,l)),...o?[o]:[]),t.may_write||this.list.append(F("p",{class:"reason"},"You may look, not change: this needs a token with the scope \u201Cwrite\u201D.")),r&&document.getElementById(r)?.focus()}row(e,t){let n=e.methods[t],s=this.store.hello.methods.find(u=>u.name===n.name),r=JSON.parse(n.settings),o=this.store.hello.may_write,a=this.store.tracksOf(this.id).find(u=>u.method.number===n.number&&u.running)?.colour??0,l=F("i",{class:"key"});l.style.setProperty("--key",`var(--m${a})`);let c=Object.keys(r).length,h=F("select",{id:`method-${t}`,"aria-label":`Method ${t+1}`,disabled:!o,onchange:()=>{this.change(t,{name:h.value,settings:{}})}},...this.store.hello.methods.map(u=>F("option",{value:u.name,selected:u.name===n.name},u.name))),d=F("details",{open:this.open.has(n.name)},F("summary",{},`Parameters${c?` (${c} changed)`:""}`,t===0&&e.methods.length>1?F("span",{class:"first"},"drawn solid"):null),s?this.parameters(s,r,t,o):null);return d.addEventListener("toggle",()=>this.open[d.open?"add":"delete"](n.name)),F("div",{class:"method"},F("div",{class:"line"},l,h,e.methods.length>1&&o?F("button",{class:"quiet","aria-label":`Stop ${n.name}`,title:"Stop this method",onclick:()=>{this.ask(this.wanted.filter((u,f)=>f!==t))}},"\xD7"):null),d)}adding(e,t){if(!this.store.hello.may_write||t.methods.length>=cw)return null;let n=new Set(t.methods.map(r=>r.name)),s=F("select",{id:"method-add","aria-label":"Run another method beside",onchange:()=>{s.value&&this.ask([...this.wanted,{name:s.value,settings:{}}]),s.value=""}},F("option",{value:""},"Overlay another method \u2026"),...e.filter(({name:r})=>!n.has(r)).map(({name:r})=>F("option",{value:r},r)));return s}parameters(e,t,n,s){let r=e.parameters.map(a=>hw(a,t,`p-${n}-${a.name}`,s)),o=F("form",{class:"parameters"},...r.map(({element:a})=>a));return o.addEventListener("submit",a=>{a.preventDefault();let l={};for(let{parameter:c,value:h}of r){let d=h();d!==void 0&&JSON.stringify(d)!==JSON.stringify(c.default)&&(l[c.name]=d)}this.change(n,{name:e.name,settings:l})}),s&&o.append(F("div",{class:"buttons"},F("button",{type:"submit"},"Apply"),F("button",{type:"button",class:"quiet",onclick:()=>{this.change(n,{name:e.name,settings:{}})}},"Defaults"))),o}change(e,t){return this.ask(this.wanted.map((n,s)=>s===e?t:n))}async ask(e){et(this.answer,"Asked; a method is loaded first \u2026"),this.answer.classList.remove("bad");try{await this.source.ask({type:"methods",device:this.id,methods:e}),et(this.answer,"")}catch(t){et(this.answer,t.message),this.answer.classList.add("bad"),this.shown="",this.sync()}}};function hw(i,e,t,n){let{name:s,unit:r,meaning:o,low:a,high:l,choices:c,kind:h}=i,d=s in e?e[s]:i.default,u=F("label",{for:t,title:o},s,r&&h!=="choice"?F("span",{class:"unit"},` ${r}`):null),f=F("small",{},o),p=(g,S)=>F("input",{id:g,type:"number",step:h==="int"?1:"any",min:a,max:l,value:S??"",placeholder:S===null?"none":null,disabled:!n}),x=g=>g.value===""?void 0:Number(g.value);if(h==="choice"){let g=F("select",{id:t,disabled:!n},...c.map(S=>F("option",{value:JSON.stringify(S),selected:S===d},String(S??"none"))));return{parameter:i,element:F("div",{},u,g,f),value:()=>JSON.parse(g.value)}}if(h==="bool"){let g=F("input",{id:t,type:"checkbox",checked:d===!0,disabled:!n});return{parameter:i,element:F("div",{},u,g,f),value:()=>g.checked}}if(h==="interval"){let[g,S]=Array.isArray(d)?d:[null,null],[T,y]=[p(t,g),p(`${t}-to`,S)];return y.setAttribute("aria-label",`${s}, upper`),{parameter:i,element:F("div",{},u,F("span",{class:"two"},T,y),f),value:()=>T.value===""||y.value===""?void 0:[x(T),x(y)]}}let m=h==="str"?F("input",{id:t,type:"text",value:d??"",disabled:!n}):p(t,d);return{parameter:i,element:F("div",{},u,m,f),value:()=>h==="str"?m.value||void 0:x(m)}}var uw="uplot",dw="u-hz",fw="u-vt",pw="u-title",mw="u-wrap",gw="u-under",_w="u-over",vw="u-axis",xr="u-off",xw="u-select",yw="u-cursor-x",Sw="u-cursor-y",Mw="u-cursor-pt",bw="u-legend",ww="u-live",Ew="u-inline",Tw="u-series",Aw="u-marker",Vg="u-label",Rw="u-value",Ja="width",Ka="height";var Wg="bottom",wo="left",_f="right",Nf="#000",Xg=Nf+"0",vf="mousemove",qg="mousedown",xf="mouseup",Yg="mouseenter",$g="mouseleave",Zg="dblclick",Cw="resize",Pw="scroll",Jg="change",Gh="dppxchange",Uf="--",Io=typeof window<"u",wf=Io?document:null,To=Io?window:null,Iw=Io?navigator:null,Dt,Bh;function Ef(){let i=devicePixelRatio;Dt!=i&&(Dt=i,Bh&&Af(Jg,Bh,Ef),Bh=matchMedia(`(min-resolution: ${Dt-.001}dppx) and (max-resolution: ${Dt+.001}dppx)`),yr(Jg,Bh,Ef),To.dispatchEvent(new CustomEvent(Gh)))}function hi(i,e){if(e!=null){let t=i.classList;!t.contains(e)&&t.add(e)}}function Tf(i,e){let t=i.classList;t.contains(e)&&t.remove(e)}function Kt(i,e,t){i.style[e]=t+"px"}function Ni(i,e,t,n){let s=wf.createElement(i);return e!=null&&hi(s,e),t?.insertBefore(s,n),s}function vi(i,e){return Ni("div",i,e)}var Kg=new WeakMap;function ts(i,e,t,n,s){let r="translate("+e+"px,"+t+"px)",o=Kg.get(i);r!=o&&(i.style.transform=r,Kg.set(i,r),e<0||t<0||e>n||t>s?hi(i,xr):Tf(i,xr))}var Qg=new WeakMap;function jg(i,e,t){let n=e+t,s=Qg.get(i);n!=s&&(Qg.set(i,n),i.style.background=e,i.style.borderColor=t)}var e0=new WeakMap;function t0(i,e,t,n){let s=e+""+t,r=e0.get(i);s!=r&&(e0.set(i,s),i.style.height=t+"px",i.style.width=e+"px",i.style.marginLeft=n?-e/2+"px":0,i.style.marginTop=n?-t/2+"px":0)}var Ff={passive:!0},Lw={...Ff,capture:!0};function yr(i,e,t,n){e.addEventListener(i,t,n?Lw:Ff)}function Af(i,e,t,n){e.removeEventListener(i,t,Ff)}Io&&Ef();function Ui(i,e,t,n){let s;t=t||0,n=n||e.length-1;let r=n<=2147483647;for(;n-t>1;)s=r?t+n>>1:ui((t+n)/2),e[s]<i?t=s:n=s;return i-e[t]<=e[n]-i?t:n}function C0(i){return(t,n,s)=>{let r=-1,o=-1;for(let a=n;a<=s;a++)if(i(t[a])){r=a;break}for(let a=s;a>=n;a--)if(i(t[a])){o=a;break}return[r,o]}}var P0=i=>i!=null,I0=i=>i!=null&&i>0,Xh=C0(P0),Dw=C0(I0);function Nw(i,e,t,n=0,s=!1){let r=s?Dw:Xh,o=s?I0:P0;[e,t]=r(i,e,t);let a=i[e],l=i[e];if(e>-1)if(n==1)a=i[e],l=i[t];else if(n==-1)a=i[t],l=i[e];else for(let c=e;c<=t;c++){let h=i[c];o(h)&&(h<a?a=h:h>l&&(l=h))}return[a??Gt,l??-Gt]}function qh(i,e,t,n){let s=s0(i),r=s0(e);i==e&&(s==-1?(i*=t,e/=t):(i/=t,e*=t));let o=t==10?ys:L0,a=s==1?ui:xi,l=r==1?xi:ui,c=a(o(Mn(i))),h=l(o(Mn(e))),d=Ao(t,c),u=Ao(t,h);return t==10&&(c<0&&(d=Vt(d,-c)),h<0&&(u=Vt(u,-h))),n||t==2?(i=d*s,e=u*r):(i=F0(i,d),e=Yh(e,u)),[i,e]}function Of(i,e,t,n){let s=qh(i,e,t,n);return i==0&&(s[0]=0),e==0&&(s[1]=0),s}var Bf=.1,n0={mode:3,pad:Bf},ja={pad:0,soft:null,mode:0},Uw={min:ja,max:ja};function Vh(i,e,t,n){return $h(t)?i0(i,e,t):(ja.pad=t,ja.soft=n?0:null,ja.mode=n?3:0,i0(i,e,Uw))}function Pt(i,e){return i??e}function Fw(i,e,t){for(e=Pt(e,0),t=Pt(t,i.length-1);e<=t;){if(i[e]!=null)return!0;e++}return!1}function i0(i,e,t){let n=t.min,s=t.max,r=Pt(n.pad,0),o=Pt(s.pad,0),a=Pt(n.hard,-Gt),l=Pt(s.hard,Gt),c=Pt(n.soft,Gt),h=Pt(s.soft,-Gt),d=Pt(n.mode,0),u=Pt(s.mode,0),f=e-i,p=ys(f),x=Qn(Mn(i),Mn(e)),m=ys(x),g=Mn(m-p);(f<1e-24||g>10)&&(f=0,(i==0||e==0)&&(f=1e-24,d==2&&c!=Gt&&(r=0),u==2&&h!=-Gt&&(o=0)));let S=f||x||1e3,T=ys(S),y=Ao(10,ui(T)),C=S*(f==0?i==0?.1:1:r),A=Vt(F0(i-C,y/10),24),v=i>=c&&(d==1||d==3&&A<=c||d==2&&A>=c)?c:Gt,E=Qn(a,A<v&&i>=v?v:Fi(v,A)),k=S*(f==0?e==0?.1:1:o),N=Vt(Yh(e+k,y/10),24),I=e<=h&&(u==1||u==3&&N>=h||u==2&&N<=h)?h:-Gt,G=Fi(l,N>I&&e<=I?I:Qn(I,N));return E==G&&E==0&&(G=100),[E,G]}var Ow=new Intl.NumberFormat(Io?Iw.language:"en-US"),kf=i=>Ow.format(i),di=Math,Hh=di.PI,Mn=di.abs,ui=di.floor,Sn=di.round,xi=di.ceil,Fi=di.min,Qn=di.max,Ao=di.pow,s0=di.sign,ys=di.log10,L0=di.log2,Bw=(i,e=1)=>di.sinh(i)*e,yf=(i,e=1)=>di.asinh(i/e),Gt=1/0;function r0(i){return(ys((i^i>>31)-(i>>31))|0)+1}function Rf(i,e,t){return Fi(Qn(i,e),t)}function D0(i){return typeof i=="function"}function At(i){return D0(i)?i:()=>i}var kw=()=>{},N0=i=>i,U0=(i,e)=>e,zw=i=>null,o0=i=>!0,a0=(i,e)=>i==e,Hw=/\.\d*?(?=9{6,}|0{6,})/gm,Sr=i=>{if(B0(i)||$s.has(i))return i;let e=`${i}`,t=e.match(Hw);if(t==null)return i;let n=t[0].length-1;if(e.indexOf("e-")!=-1){let[s,r]=e.split("e");return+`${Sr(s)}e${r}`}return Vt(i,n)};function _r(i,e){return Sr(Vt(Sr(i/e))*e)}function Yh(i,e){return Sr(xi(Sr(i/e))*e)}function F0(i,e){return Sr(ui(Sr(i/e))*e)}function Vt(i,e=0){if(B0(i))return i;let t=10**e,n=i*t*(1+Number.EPSILON);return Sn(n)/t}var $s=new Map;function O0(i){return((""+i).split(".")[1]||"").length}function tl(i,e,t,n){let s=[],r=n.map(O0);for(let o=e;o<t;o++){let a=Mn(o),l=Vt(Ao(i,o),a);for(let c=0;c<n.length;c++){let h=i==10?+`${n[c]}e${o}`:n[c]*l,d=(o>=0?0:a)+(o>=r[c]?0:r[c]),u=i==10?h:Vt(h,d);s.push(u),$s.set(u,d)}}return s}var el={},zf=[],Ro=[null,null],Ys=Array.isArray,B0=Number.isInteger,Gw=i=>i===void 0;function l0(i){return typeof i=="string"}function $h(i){let e=!1;if(i!=null){let t=i.constructor;e=t==null||t==Object}return e}function Vw(i){return i!=null&&typeof i=="object"}var Ww=Object.getPrototypeOf(Uint8Array),k0="__proto__";function Co(i,e=$h){let t;if(Ys(i)){let n=i.find(s=>s!=null);if(Ys(n)||e(n)){t=Array(i.length);for(let s=0;s<i.length;s++)t[s]=Co(i[s],e)}else t=i.slice()}else if(i instanceof Ww)t=i.slice();else if(e(i)){t={};for(let n in i)n!=k0&&(t[n]=Co(i[n],e))}else t=i;return t}function gn(i){let e=arguments;for(let t=1;t<e.length;t++){let n=e[t];for(let s in n)s!=k0&&($h(i[s])?gn(i[s],Co(n[s])):i[s]=Co(n[s]))}return i}var Xw=0,qw=1,Yw=2;function $w(i,e,t){for(let n=0,s,r=-1;n<e.length;n++){let o=e[n];if(o>r){for(s=o-1;s>=0&&i[s]==null;)i[s--]=null;for(s=o+1;s<t&&i[s]==null;)i[r=s++]=null}}}function Zw(i,e){if(Qw(i)){let o=i[0].slice();for(let a=1;a<i.length;a++)o.push(...i[a].slice(1));return jw(o[0])||(o=Kw(o)),o}let t=new Set;for(let o=0;o<i.length;o++){let l=i[o][0],c=l.length;for(let h=0;h<c;h++)t.add(l[h])}let n=[Array.from(t).sort((o,a)=>o-a)],s=n[0].length,r=new Map;for(let o=0;o<s;o++)r.set(n[0][o],o);for(let o=0;o<i.length;o++){let a=i[o],l=a[0];for(let c=1;c<a.length;c++){let h=a[c],d=Array(s).fill(void 0),u=e?e[o][c]:qw,f=[];for(let p=0;p<h.length;p++){let x=h[p],m=r.get(l[p]);x===null?u!=Xw&&(d[m]=x,u==Yw&&f.push(m)):d[m]=x}$w(d,f,s),n.push(d)}}return n}var Jw=typeof queueMicrotask>"u"?i=>Promise.resolve().then(i):queueMicrotask;function Kw(i){let e=i[0],t=e.length,n=Array(t);for(let r=0;r<n.length;r++)n[r]=r;n.sort((r,o)=>e[r]-e[o]);let s=[];for(let r=0;r<i.length;r++){let o=i[r],a=Array(t);for(let l=0;l<t;l++)a[l]=o[n[l]];s.push(a)}return s}function Qw(i){let e=i[0][0],t=e.length;for(let n=1;n<i.length;n++){let s=i[n][0];if(s.length!=t)return!1;if(s!=e){for(let r=0;r<t;r++)if(s[r]!=e[r])return!1}}return!0}function jw(i,e=100){let t=i.length;if(t<=1)return!0;let n=0,s=t-1;for(;n<=s&&i[n]==null;)n++;for(;s>=n&&i[s]==null;)s--;if(s<=n)return!0;let r=Qn(1,ui((s-n+1)/e));for(let o=i[n],a=n+r;a<=s;a+=r){let l=i[a];if(l!=null){if(l<=o)return!1;o=l}}return!0}var z0=["January","February","March","April","May","June","July","August","September","October","November","December"],H0=["Sunday","Monday","Tuesday","Wednesday","Thursday","Friday","Saturday"];function G0(i){return i.slice(0,3)}var eE=H0.map(G0),tE=z0.map(G0),nE={MMMM:z0,MMM:tE,WWWW:H0,WWW:eE};function Za(i){return(i<10?"0":"")+i}function iE(i){return(i<10?"00":i<100?"0":"")+i}var sE={YYYY:i=>i.getFullYear(),YY:i=>(i.getFullYear()+"").slice(2),MMMM:(i,e)=>e.MMMM[i.getMonth()],MMM:(i,e)=>e.MMM[i.getMonth()],MM:i=>Za(i.getMonth()+1),M:i=>i.getMonth()+1,DD:i=>Za(i.getDate()),D:i=>i.getDate(),WWWW:(i,e)=>e.WWWW[i.getDay()],WWW:(i,e)=>e.WWW[i.getDay()],HH:i=>Za(i.getHours()),H:i=>i.getHours(),h:i=>{let e=i.getHours();return e==0?12:e>12?e-12:e},AA:i=>i.getHours()>=12?"PM":"AM",aa:i=>i.getHours()>=12?"pm":"am",a:i=>i.getHours()>=12?"p":"a",mm:i=>Za(i.getMinutes()),m:i=>i.getMinutes(),ss:i=>Za(i.getSeconds()),s:i=>i.getSeconds(),fff:i=>iE(i.getMilliseconds())};function Hf(i,e){e=e||nE;let t=[],n=/\{([a-z]+)\}|[^{]+/gi,s;for(;s=n.exec(i);)t.push(s[0][0]=="{"?sE[s[1]]:s[0]);return r=>{let o="";for(let a=0;a<t.length;a++)o+=typeof t[a]=="string"?t[a]:t[a](r,e);return o}}var rE=new Intl.DateTimeFormat().resolvedOptions().timeZone;function oE(i,e){let t;return e=="UTC"||e=="Etc/UTC"?t=new Date(+i+i.getTimezoneOffset()*6e4):e==rE?t=i:(t=new Date(i.toLocaleString("en-US",{timeZone:e})),t.setMilliseconds(i.getMilliseconds())),t}var V0=i=>i%1==0,Wh=[1,2,2.5,5],aE=tl(10,-32,0,Wh),W0=tl(10,0,32,Wh),lE=W0.filter(V0),vr=aE.concat(W0),Gf=`
`,X0="{YYYY}",c0=Gf+X0,q0="{M}/{D}",Qa=Gf+q0,kh=Qa+"/{YY}",Y0="{aa}",cE="{h}:{mm}",Eo=cE+Y0,h0=Gf+Eo,u0=":{ss}",Ot=null;function $0(i){let e=i*1e3,t=e*60,n=t*60,s=n*24,r=s*30,o=s*365,l=(i==1?tl(10,0,3,Wh).filter(V0):tl(10,-3,0,Wh)).concat([e,e*5,e*10,e*15,e*30,t,t*5,t*10,t*15,t*30,n,n*2,n*3,n*4,n*6,n*8,n*12,s,s*2,s*3,s*4,s*5,s*6,s*7,s*8,s*9,s*10,s*15,r,r*2,r*3,r*4,r*6,o,o*2,o*5,o*10,o*25,o*50,o*100]),c=[[o,X0,Ot,Ot,Ot,Ot,Ot,Ot,1],[s*28,"{MMM}",c0,Ot,Ot,Ot,Ot,Ot,1],[s,q0,c0,Ot,Ot,Ot,Ot,Ot,1],[n,"{h}"+Y0,kh,Ot,Qa,Ot,Ot,Ot,1],[t,Eo,kh,Ot,Qa,Ot,Ot,Ot,1],[e,u0,kh+" "+Eo,Ot,Qa+" "+Eo,Ot,h0,Ot,1],[i,u0+".{fff}",kh+" "+Eo,Ot,Qa+" "+Eo,Ot,h0,Ot,1]];function h(d){return(u,f,p,x,m,g)=>{let S=[],T=m>=o,y=m>=r&&m<o,C=d(p),A=Vt(C*i,3),v=Sf(C.getFullYear(),T?0:C.getMonth(),y||T?1:C.getDate()),E=Vt(v*i,3);if(y||T){let k=y?m/r:0,N=T?m/o:0,I=A==E?A:Vt(Sf(v.getFullYear()+N,v.getMonth()+k,1)*i,3),G=new Date(Sn(I/i)),W=G.getFullYear(),L=G.getMonth();for(let H=0;I<=x;H++){let Y=Sf(W+N*H,L+k*H,1),z=Y-d(Vt(Y*i,3));I=Vt((+Y+z)*i,3),I<=x&&S.push(I)}}else{let k=m>=s?s:m,N=ui(p)-ui(A),I=E+N+Yh(A-E,k);S.push(I);let G=d(I),W=G.getHours()+G.getMinutes()/t+G.getSeconds()/n,L=m/n,H=u.axes[f]._space,Y=g/H;for(;I=Vt(I+m,i==1?0:3),!(I>x);)if(L>1){let z=ui(Vt(W+L,6))%24,j=d(I).getHours()-z;j>1&&(j=-1),I-=j*n,W=(W+L)%24;let te=S[S.length-1];Vt((I-te)/m,3)*Y>=.7&&S.push(I)}else S.push(I)}return S}}return[l,c,h]}var[hE,uE,dE]=$0(1),[fE,pE,mE]=$0(.001);tl(2,-53,53,[1]);function d0(i,e){return i.map(t=>t.map((n,s)=>s==0||s==8||n==null?n:e(s==1||t[8]==0?n:t[1]+n)))}function f0(i,e){return(t,n,s,r,o)=>{let a=e.find(p=>o>=p[0])||e[e.length-1],l,c,h,d,u,f;return n.map(p=>{let x=i(p),m=x.getFullYear(),g=x.getMonth(),S=x.getDate(),T=x.getHours(),y=x.getMinutes(),C=x.getSeconds(),A=m!=l&&a[2]||g!=c&&a[3]||S!=h&&a[4]||T!=d&&a[5]||y!=u&&a[6]||C!=f&&a[7]||a[1];return l=m,c=g,h=S,d=T,u=y,f=C,A(x)})}}function gE(i,e){let t=Hf(e);return(n,s,r,o,a)=>s.map(l=>t(i(l)))}function Sf(i,e,t){return new Date(i,e,t)}function p0(i,e){return e(i)}var _E="{YYYY}-{MM}-{DD} {h}:{mm}{aa}";function m0(i,e){return(t,n,s,r)=>r==null?Uf:e(i(n))}function vE(i,e){let t=i.series[e];return t.width?t.stroke(i,e):t.points.width?t.points.stroke(i,e):null}function xE(i,e){return i.series[e].fill(i,e)}var yE={show:!0,live:!0,isolate:!1,mount:kw,markers:{show:!0,width:2,stroke:vE,fill:xE,dash:"solid"},idx:null,idxs:null,values:[]};function SE(i,e){let t=i.cursor.points,n=vi(),s=t.size(i,e);Kt(n,Ja,s),Kt(n,Ka,s);let r=s/-2;Kt(n,"marginLeft",r),Kt(n,"marginTop",r);let o=t.width(i,e,s);return o&&Kt(n,"borderWidth",o),n}function ME(i,e){let t=i.series[e].points;return t._fill||t._stroke}function bE(i,e){let t=i.series[e].points;return t._stroke||t._fill}function wE(i,e){return i.series[e].points.size}var Mf=[0,0];function EE(i,e,t){return Mf[0]=e,Mf[1]=t,Mf}function zh(i,e,t,n=!0){return s=>{s.button==0&&(!n||s.target==e)&&t(s)}}function bf(i,e,t,n=!0){return s=>{(!n||s.target==e)&&t(s)}}var TE={show:!0,x:!0,y:!0,lock:!1,move:EE,points:{one:!1,show:SE,size:wE,width:0,stroke:bE,fill:ME},bind:{mousedown:zh,mouseup:zh,click:zh,dblclick:zh,mousemove:bf,mouseleave:bf,mouseenter:bf},drag:{setScale:!0,x:!0,y:!1,dist:0,uni:null,click:(i,e)=>{e.stopPropagation(),e.stopImmediatePropagation()},_x:!1,_y:!1},focus:{dist:(i,e,t,n,s)=>n-s,prox:-1,bias:0},hover:{skip:[void 0],prox:null,bias:0},left:-10,top:-10,idx:null,dataIdx:null,idxs:null,event:null},Z0={show:!0,stroke:"rgba(0,0,0,0.07)",width:2},Vf=gn({},Z0,{filter:U0}),J0=gn({},Vf,{size:10}),K0=gn({},Z0,{show:!1}),Wf='12px system-ui, -apple-system, "Segoe UI", Roboto, "Helvetica Neue", Arial, "Noto Sans", sans-serif, "Apple Color Emoji", "Segoe UI Emoji", "Segoe UI Symbol", "Noto Color Emoji"',Q0="bold "+Wf,j0=1.5,g0={show:!0,scale:"x",stroke:Nf,space:50,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Q0,side:2,grid:Vf,ticks:J0,border:K0,font:Wf,lineGap:j0,rotate:0},AE="Value",RE="Time",_0={show:!0,scale:"x",auto:!1,sorted:1,min:Gt,max:-Gt,idxs:[]};function CE(i,e,t,n,s){return e.map(r=>r==null?"":kf(r))}function PE(i,e,t,n,s,r,o){let a=[],l=$s.get(s)||0;t=o?t:Vt(Yh(t,s),l);for(let c=t;c<=n;c=Vt(c+s,l))a.push(Object.is(c,-0)?0:c);return a}function Cf(i,e,t,n,s,r,o){let a=[],l=i.scales[i.axes[e].scale].log,c=l==10?ys:L0,h=ui(c(t));s=Ao(l,h),l==10&&(s=vr[Ui(s,vr)]);let d=t,u=s*l;l==10&&(u=vr[Ui(u,vr)]);do a.push(d),d=d+s,l==10&&!$s.has(d)&&(d=Vt(d,$s.get(s))),d>=u&&(s=d,u=s*l,l==10&&(u=vr[Ui(u,vr)]));while(d<=n);return a}function IE(i,e,t,n,s,r,o){let l=i.scales[i.axes[e].scale].asinh,c=n>l?Cf(i,e,Qn(l,t),n,s):[l],h=n>=0&&t<=0?[0]:[];return(t<-l?Cf(i,e,Qn(l,-n),-t,s):[l]).reverse().map(u=>-u).concat(h,c)}var e_=/./,LE=/[12357]/,DE=/[125]/,v0=/1/,Pf=(i,e,t,n)=>i.map((s,r)=>e==4&&s==0||r%n==0&&t.test(s.toExponential()[s<0?1:0])?s:null);function NE(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=i.scales[o],l=i.valToPos,c=r._space,h=l(10,o),d=l(9,o)-h>=c?e_:l(7,o)-h>=c?LE:l(5,o)-h>=c?DE:v0;if(d==v0){let u=Mn(l(1,o)-h);if(u<c)return Pf(e.slice().reverse(),a.distr,d,xi(c/u)).reverse()}return Pf(e,a.distr,d,1)}function UE(i,e,t,n,s){let r=i.axes[t],o=r.scale,a=r._space,l=i.valToPos,c=Mn(l(1,o)-l(2,o));return c<a?Pf(e.slice().reverse(),3,e_,xi(a/c)).reverse():e}function FE(i,e,t,n){return n==null?Uf:e==null?"":kf(e)}var x0={show:!0,scale:"y",stroke:Nf,space:30,gap:5,alignTo:1,size:50,labelGap:0,labelSize:30,labelFont:Q0,side:3,grid:Vf,ticks:J0,border:K0,font:Wf,lineGap:j0,rotate:0};function OE(i,e){let t=3+(i||1)*2;return Vt(t*e,3)}function BE(i,e){let{scale:t,idxs:n}=i.series[0],s=i._data[0],r=i.valToPos(s[n[0]],t,!0),o=i.valToPos(s[n[1]],t,!0),a=Mn(o-r),l=i.series[e],c=a/(l.points.space*Dt);return n[1]-n[0]<=c}var y0={scale:null,auto:!0,sorted:0,min:Gt,max:-Gt},t_=(i,e,t,n,s)=>s,S0={show:!0,auto:!0,sorted:0,gaps:t_,alpha:1,facets:[gn({},y0,{scale:"x"}),gn({},y0,{scale:"y"})]},M0={scale:"y",auto:!0,sorted:0,show:!0,spanGaps:!1,gaps:t_,alpha:1,points:{show:BE,filter:null},values:null,min:Gt,max:-Gt,idxs:[],path:null,clip:null};function kE(i,e,t,n,s){return t/10}var n_={time:!0,auto:!0,distr:1,log:10,asinh:1,min:null,max:null,dir:1,ori:0},zE=gn({},n_,{time:!1,ori:1}),b0={};function i_(i,e){let t=b0[i];return t||(t={key:i,plots:[],sub(n){t.plots.push(n)},unsub(n){t.plots=t.plots.filter(s=>s!=n)},pub(n,s,r,o,a,l,c){for(let h=0;h<t.plots.length;h++)t.plots[h]!=s&&t.plots[h].pub(n,s,r,o,a,l,c)}},i!=null&&(b0[i]=t)),t}var Po=1,If=2;function Mr(i,e,t){let n=i.mode,s=i.series[e],r=n==2?i._data[e]:i._data,o=i.scales,a=i.bbox,l=r[0],c=n==2?r[1]:r[e],h=n==2?o[s.facets[0].scale]:o[i.series[0].scale],d=n==2?o[s.facets[1].scale]:o[s.scale],u=a.left,f=a.top,p=a.width,x=a.height,m=i.valToPosH,g=i.valToPosV;return h.ori==0?t(s,l,c,h,d,m,g,u,f,p,x,Jh,Lo,Qh,r_,a_):t(s,l,c,h,d,g,m,f,u,x,p,Kh,Do,Yf,o_,l_)}function Xf(i,e){let t=0,n=0,s=Pt(i.bands,zf);for(let r=0;r<s.length;r++){let o=s[r];o.series[0]==e?t=o.dir:o.series[1]==e&&(o.dir==1?n|=1:n|=2)}return[t,n==1?-1:n==2?1:n==3?2:0]}function HE(i,e,t,n,s){let r=i.mode,o=i.series[e],a=r==2?o.facets[1].scale:o.scale,l=i.scales[a];return s==-1?l.min:s==1?l.max:l.distr==3?l.dir==1?l.min:l.max:0}function Ss(i,e,t,n,s,r){return Mr(i,e,(o,a,l,c,h,d,u,f,p,x,m)=>{let g=o.pxRound,S=c.dir*(c.ori==0?1:-1),T=c.ori==0?Lo:Do,y,C;S==1?(y=t,C=n):(y=n,C=t);let A=g(d(a[y],c,x,f)),v=g(u(l[y],h,m,p)),E=g(d(a[C],c,x,f)),k=g(u(r==1?h.max:h.min,h,m,p)),N=new Path2D(s);return T(N,E,k),T(N,A,k),T(N,A,v),N})}function Zh(i,e,t,n,s,r){let o=null;if(i.length>0){o=new Path2D;let a=e==0?Qh:Yf,l=t;for(let d=0;d<i.length;d++){let u=i[d];if(u[1]>u[0]){let f=u[0]-l;f>0&&a(o,l,n,f,n+r),l=u[1]}}let c=t+s-l,h=10;c>0&&a(o,l,n-h/2,c,n+r+h)}return o}function GE(i,e,t){let n=i[i.length-1];n&&n[0]==e?n[1]=t:i.push([e,t])}function qf(i,e,t,n,s,r,o){let a=[],l=i.length;for(let c=s==1?t:n;c>=t&&c<=n;c+=s)if(e[c]===null){let d=c,u=c;if(s==1)for(;++c<=n&&e[c]===null;)u=c;else for(;--c>=t&&e[c]===null;)u=c;let f=r(i[d]),p=u==d?f:r(i[u]),x=d-s;f=o<=0&&x>=0&&x<l?r(i[x]):f;let g=u+s;p=o>=0&&g>=0&&g<l?r(i[g]):p,p>=f&&a.push([f,p])}return a}function w0(i){return i==0?N0:i==1?Sn:e=>_r(e,i)}function s_(i){let e=i==0?Jh:Kh,t=i==0?(s,r,o,a,l,c)=>{s.arcTo(r,o,a,l,c)}:(s,r,o,a,l,c)=>{s.arcTo(o,r,l,a,c)},n=i==0?(s,r,o,a,l)=>{s.rect(r,o,a,l)}:(s,r,o,a,l)=>{s.rect(o,r,l,a)};return(s,r,o,a,l,c=0,h=0)=>{c==0&&h==0?n(s,r,o,a,l):(c=Fi(c,a/2,l/2),h=Fi(h,a/2,l/2),e(s,r+c,o),t(s,r+a,o,r+a,o+l,c),t(s,r+a,o+l,r,o+l,h),t(s,r,o+l,r,o,h),t(s,r,o,r+a,o,c),s.closePath())}}var Jh=(i,e,t)=>{i.moveTo(e,t)},Kh=(i,e,t)=>{i.moveTo(t,e)},Lo=(i,e,t)=>{i.lineTo(e,t)},Do=(i,e,t)=>{i.lineTo(t,e)},Qh=s_(0),Yf=s_(1),r_=(i,e,t,n,s,r)=>{i.arc(e,t,n,s,r)},o_=(i,e,t,n,s,r)=>{i.arc(t,e,n,s,r)},a_=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(e,t,n,s,r,o)},l_=(i,e,t,n,s,r,o)=>{i.bezierCurveTo(t,e,s,n,o,r)};function c_(i){return(e,t,n,s,r)=>Mr(e,t,(o,a,l,c,h,d,u,f,p,x,m)=>{let{pxRound:g,points:S}=o,T,y;c.ori==0?(T=Jh,y=r_):(T=Kh,y=o_);let C=Vt(S.width*Dt,3),A=(S.size-S.width)/2*Dt,v=Vt(A*2,3),E=new Path2D,k=new Path2D,{left:N,top:I,width:G,height:W}=e.bbox;Qh(k,N-v,I-v,G+v*2,W+v*2);let L=H=>{if(l[H]!=null){let Y=g(d(a[H],c,x,f)),z=g(u(l[H],h,m,p));T(E,Y+A,z),y(E,Y,z,A,0,Hh*2)}};if(r)r.forEach(L);else for(let H=n;H<=s;H++)L(H);return{stroke:C>0?E:null,fill:E,clip:k,flags:Po|If}})}function h_(i){return(e,t,n,s,r,o)=>{n!=s&&(r!=n&&o!=n&&i(e,t,n),r!=s&&o!=s&&i(e,t,s),i(e,t,o))}}var VE=h_(Lo),WE=h_(Do);function u_(i){let e=Pt(i?.alignGaps,0);return(t,n,s,r)=>Mr(t,n,(o,a,l,c,h,d,u,f,p,x,m)=>{[s,r]=Xh(l,s,r);let g=o.pxRound,S=W=>g(d(W,c,x,f)),T=W=>g(u(W,h,m,p)),y,C;c.ori==0?(y=Lo,C=VE):(y=Do,C=WE);let A=c.dir*(c.ori==0?1:-1),v={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Po},E=v.stroke,k=!1;if(r-s>=x*4){let W=he=>t.posToVal(he,c.key,!0),L=null,H=null,Y,z,ce,J=S(a[A==1?s:r]),j=S(a[s]),te=S(a[r]),fe=W(A==1?j+1:te-1);for(let he=A==1?s:r;he>=s&&he<=r;he+=A){let ee=a[he],ve=(A==1?ee<fe:ee>fe)?J:S(ee),Ie=l[he];ve==J?Ie!=null?(z=Ie,L==null?(y(E,ve,T(z)),Y=L=H=z):z<L?L=z:z>H&&(H=z)):Ie===null&&(k=!0):(L!=null&&C(E,J,T(L),T(H),T(Y),T(z)),Ie!=null?(z=Ie,y(E,ve,T(z)),L=H=Y=z):(L=H=null,Ie===null&&(k=!0)),J=ve,fe=W(J+A))}L!=null&&L!=H&&ce!=J&&C(E,J,T(L),T(H),T(Y),T(z))}else for(let W=A==1?s:r;W>=s&&W<=r;W+=A){let L=l[W];L===null?k=!0:L!=null&&y(E,S(a[W]),T(L))}let[I,G]=Xf(t,n);if(o.fill!=null||I!=0){let W=v.fill=new Path2D(E),L=o.fillTo(t,n,o.min,o.max,I),H=T(L),Y=S(a[s]),z=S(a[r]);A==-1&&([z,Y]=[Y,z]),y(W,z,H),y(W,Y,H)}if(!o.spanGaps){let W=[];k&&W.push(...qf(a,l,s,r,A,S,e)),v.gaps=W=o.gaps(t,n,s,r,W),v.clip=Zh(W,c.ori,f,p,x,m)}return G!=0&&(v.band=G==2?[Ss(t,n,s,r,E,-1),Ss(t,n,s,r,E,1)]:Ss(t,n,s,r,E,G)),v})}function XE(i){let e=Pt(i.align,1),t=Pt(i.ascDesc,!1),n=Pt(i.alignGaps,0),s=Pt(i.extend,!1);return(r,o,a,l)=>Mr(r,o,(c,h,d,u,f,p,x,m,g,S,T)=>{[a,l]=Xh(d,a,l);let y=c.pxRound,{left:C,width:A}=r.bbox,v=j=>y(p(j,u,S,m)),E=j=>y(x(j,f,T,g)),k=u.ori==0?Lo:Do,N={stroke:new Path2D,fill:null,clip:null,band:null,gaps:null,flags:Po},I=N.stroke,G=u.dir*(u.ori==0?1:-1),W=E(d[G==1?a:l]),L=v(h[G==1?a:l]),H=L,Y=L;s&&e==-1&&(Y=C,k(I,Y,W)),k(I,L,W);for(let j=G==1?a:l;j>=a&&j<=l;j+=G){let te=d[j];if(te==null)continue;let fe=v(h[j]),he=E(te);e==1?k(I,fe,W):k(I,H,he),k(I,fe,he),W=he,H=fe}let z=H;s&&e==1&&(z=C+A,k(I,z,W));let[ce,J]=Xf(r,o);if(c.fill!=null||ce!=0){let j=N.fill=new Path2D(I),te=c.fillTo(r,o,c.min,c.max,ce),fe=E(te);k(j,z,fe),k(j,Y,fe)}if(!c.spanGaps){let j=[];j.push(...qf(h,d,a,l,G,v,n));let te=c.width*Dt/2,fe=t||e==1?te:-te,he=t||e==-1?-te:te;j.forEach(ee=>{ee[0]+=fe,ee[1]+=he}),N.gaps=j=c.gaps(r,o,a,l,j),N.clip=Zh(j,u.ori,m,g,S,T)}return J!=0&&(N.band=J==2?[Ss(r,o,a,l,I,-1),Ss(r,o,a,l,I,1)]:Ss(r,o,a,l,I,J)),N})}function E0(i,e,t,n,s,r,o=Gt){if(i.length>1){let a=null;for(let l=0,c=1/0;l<i.length;l++)if(e[l]!==void 0){if(a!=null){let h=Mn(i[l]-i[a]);h<c&&(c=h,o=Mn(t(i[l],n,s,r)-t(i[a],n,s,r)))}a=l}}return o}function qE(i){i=i||el;let e=Pt(i.size,[.6,Gt,1]),t=i.align||0,n=i.gap||0,s=i.radius;s=s==null?[0,0]:typeof s=="number"?[s,0]:s;let r=At(s),o=1-e[0],a=Pt(e[1],Gt),l=Pt(e[2],1),c=Pt(i.disp,el),h=Pt(i.each,f=>{}),{fill:d,stroke:u}=c;return(f,p,x,m)=>Mr(f,p,(g,S,T,y,C,A,v,E,k,N,I)=>{let G=g.pxRound,W=t,L=n*Dt,H=a*Dt,Y=l*Dt,z,ce;y.ori==0?[z,ce]=r(f,p):[ce,z]=r(f,p);let J=y.dir*(y.ori==0?1:-1),j=y.ori==0?Qh:Yf,te=y.ori==0?h:(Se,Xe,ht,we,Nt,$e,je)=>{h(Se,Xe,ht,Nt,we,je,$e)},fe=Pt(f.bands,zf).find(Se=>Se.series[0]==p),he=fe!=null?fe.dir:0,ee=g.fillTo(f,p,g.min,g.max,he),ge=G(v(ee,C,I,k)),ve,Ie,be,Ge=N,st=G(g.width*Dt),Je=!1,rt=null,it=null,oe=null,xe=null;d!=null&&(st==0||u!=null)&&(Je=!0,rt=d.values(f,p,x,m),it=new Map,new Set(rt).forEach(Se=>{Se!=null&&it.set(Se,new Path2D)}),st>0&&(oe=u.values(f,p,x,m),xe=new Map,new Set(oe).forEach(Se=>{Se!=null&&xe.set(Se,new Path2D)})));let{x0:_e,size:Be}=c;if(_e!=null&&Be!=null){W=1,S=_e.values(f,p,x,m),_e.unit==2&&(S=S.map(ht=>f.posToVal(E+ht*N,y.key,!0)));let Se=Be.values(f,p,x,m);Be.unit==2?Ie=Se[0]*N:Ie=A(Se[0],y,N,E)-A(0,y,N,E),Ge=E0(S,T,A,y,N,E,Ge),be=Ge-Ie+L}else Ge=E0(S,T,A,y,N,E,Ge),be=Ge*o+L,Ie=Ge-be;be<1&&(be=0),st>=Ie/2&&(st=0),be<5&&(G=N0);let Le=be>0,nt=Ge-be-(Le?st:0);Ie=G(Rf(nt,Y,H)),ve=(W==0?Ie/2:W==J?0:Ie)-W*J*((W==0?L/2:0)+(Le?st/2:0));let ke={stroke:null,fill:null,clip:null,band:null,gaps:null,flags:0},gt=Je?null:new Path2D,dt=null;if(fe!=null)dt=f.data[fe.series[1]];else{let{y0:Se,y1:Xe}=c;Se!=null&&Xe!=null&&(T=Xe.values(f,p,x,m),dt=Se.values(f,p,x,m))}let vt=z*Ie,U=ce*Ie;for(let Se=J==1?x:m;Se>=x&&Se<=m;Se+=J){let Xe=T[Se];if(Xe==null)continue;if(dt!=null){let q=dt[Se]??0;if(Xe-q==0)continue;ge=v(q,C,I,k)}let ht=y.distr!=2||c!=null?S[Se]:Se,we=A(ht,y,N,E),Nt=v(Pt(Xe,ee),C,I,k),$e=G(we-ve),je=G(Qn(Nt,ge)),R=G(Fi(Nt,ge)),M=je-R;if(Xe!=null){let q=Xe<0?U:vt,de=Xe<0?vt:U;Je?(st>0&&oe[Se]!=null&&j(xe.get(oe[Se]),$e,R+ui(st/2),Ie,Qn(0,M-st),q,de),rt[Se]!=null&&j(it.get(rt[Se]),$e,R+ui(st/2),Ie,Qn(0,M-st),q,de)):j(gt,$e,R+ui(st/2),Ie,Qn(0,M-st),q,de),te(f,p,Se,$e-st/2,R,Ie+st,M)}}return st>0?ke.stroke=Je?xe:gt:Je||(ke._fill=g.width==0?g._fill:g._stroke??g._fill,ke.width=0),ke.fill=Je?it:gt,ke})}function YE(i,e){let t=Pt(e?.alignGaps,0);return(n,s,r,o)=>Mr(n,s,(a,l,c,h,d,u,f,p,x,m,g)=>{[r,o]=Xh(c,r,o);let S=a.pxRound,T=z=>S(u(z,h,m,p)),y=z=>S(f(z,d,g,x)),C,A,v;h.ori==0?(C=Jh,v=Lo,A=a_):(C=Kh,v=Do,A=l_);let E=h.dir*(h.ori==0?1:-1),k=T(l[E==1?r:o]),N=k,I=[],G=[];for(let z=E==1?r:o;z>=r&&z<=o;z+=E)if(c[z]!=null){let J=l[z],j=T(J);I.push(N=j),G.push(y(c[z]))}let W={stroke:i(I,G,C,v,A,S),fill:null,clip:null,band:null,gaps:null,flags:Po},L=W.stroke,[H,Y]=Xf(n,s);if(a.fill!=null||H!=0){let z=W.fill=new Path2D(L),ce=a.fillTo(n,s,a.min,a.max,H),J=y(ce);v(z,N,J),v(z,k,J)}if(!a.spanGaps){let z=[];z.push(...qf(l,c,r,o,E,T,t)),W.gaps=z=a.gaps(n,s,r,o,z),W.clip=Zh(z,h.ori,p,x,m,g)}return Y!=0&&(W.band=Y==2?[Ss(n,s,r,o,L,-1),Ss(n,s,r,o,L,1)]:Ss(n,s,r,o,L,Y)),W})}function $E(i){return YE(ZE,i)}function ZE(i,e,t,n,s,r){let o=i.length;if(o<2)return null;let a=new Path2D;if(t(a,i[0],e[0]),o==2)n(a,i[1],e[1]);else{let l=Array(o),c=Array(o-1),h=Array(o-1),d=Array(o-1);for(let u=0;u<o-1;u++)h[u]=e[u+1]-e[u],d[u]=i[u+1]-i[u],c[u]=h[u]/d[u];l[0]=c[0];for(let u=1;u<o-1;u++)c[u]===0||c[u-1]===0||c[u-1]>0!=c[u]>0?l[u]=0:(l[u]=3*(d[u-1]+d[u])/((2*d[u]+d[u-1])/c[u-1]+(d[u]+2*d[u-1])/c[u]),isFinite(l[u])||(l[u]=0));l[o-1]=c[o-2];for(let u=0;u<o-1;u++)s(a,i[u]+d[u]/3,e[u]+l[u]*d[u]/3,i[u+1]-d[u]/3,e[u+1]-l[u+1]*d[u]/3,i[u+1],e[u+1])}return a}var Lf=new Set;function T0(){for(let i of Lf)i.syncRect(!0)}Io&&(yr(Cw,To,T0),yr(Pw,To,T0,!0),yr(Gh,To,()=>{bn.pxRatio=Dt}));var JE=u_(),KE=c_();function A0(i,e,t,n){return(n?[i[0],i[1]].concat(i.slice(2)):[i[0]].concat(i.slice(1))).map((r,o)=>Df(r,o,e,t))}function QE(i,e){return i.map((t,n)=>n==0?{}:gn({},e,t))}function Df(i,e,t,n){return gn({},e==0?t:n,i)}function d_(i,e,t){return e==null?Ro:[e,t]}var jE=d_;function eT(i,e,t){return e==null?Ro:Vh(e,t,Bf,!0)}function f_(i,e,t,n){return e==null?Ro:qh(e,t,i.scales[n].log,!1)}var tT=f_;function p_(i,e,t,n){return e==null?Ro:Of(e,t,i.scales[n].log,!1)}var nT=p_;function iT(i,e,t,n,s){let r=Qn(r0(i),r0(e)),o=e-i,a=Ui(s/n*o,t);do{let l=t[a],c=n*l/o;if(c>=s&&r+(l<5?$s.get(l):0)<=17)return[l,c]}while(++a<t.length);return[0,0]}function R0(i){let e,t;return i=i.replace(/(\d+)px/,(n,s)=>(e=Sn((t=+s)*Dt))+"px"),[i,e,t]}function sT(i){i.show&&[i.font,i.labelFont].forEach(e=>{let t=Vt(e[2]*Dt,1);e[0]=e[0].replace(/[0-9.]+px/,t+"px"),e[1]=t})}function bn(i,e,t){let n={mode:Pt(i.mode,1)},s=n.mode;function r(_,b,P,D){let V=b.valToPct(_);return D+P*(b.dir==-1?1-V:V)}function o(_,b,P,D){let V=b.valToPct(_);return D+P*(b.dir==-1?V:1-V)}function a(_,b,P,D){return b.ori==0?r(_,b,P,D):o(_,b,P,D)}n.valToPosH=r,n.valToPosV=o;let l=!1;n.status=0;let c=n.root=vi(uw);if(i.id!=null&&(c.id=i.id),hi(c,i.class),i.title){let _=vi(pw,c);_.textContent=i.title}let h=Ni("canvas"),d=n.ctx=h.getContext("2d"),u=vi(mw,c);yr("click",u,_=>{_.target===p&&(qt!=Ir||Qt!=Lr)&&Dn.click(n,_)},!0);let f=n.under=vi(gw,u);u.appendChild(h);let p=n.over=vi(_w,u);i=Co(i);let x=+Pt(i.pxAlign,1),m=w0(x);(i.plugins||[]).forEach(_=>{_.opts&&(i=_.opts(n,i)||i)});let g=i.ms||.001,S=n.series=s==1?A0(i.series||[],_0,M0,!1):QE(i.series||[null],S0),T=n.axes=A0(i.axes||[],g0,x0,!0),y=n.scales={},C=n.bands=i.bands||[];C.forEach(_=>{_.fill=At(_.fill||null),_.dir=Pt(_.dir,-1)});let A=s==2?S[1].facets[0].scale:S[0].scale,v={axes:rs,series:Mt},E=(i.drawOrder||["axes","series"]).map(_=>v[_]);function k(_){let b=_.distr==3?P=>ys(P>0?P:_.clamp(n,P,_.min,_.max,_.key)):_.distr==4?P=>yf(P,_.asinh):_.distr==100?P=>_.fwd(P):P=>P;return P=>{let D=b(P),{_min:V,_max:K}=_,le=K-V;return(D-V)/le}}function N(_){let b=y[_];if(b==null){let P=(i.scales||el)[_]||el;if(P.from!=null){N(P.from);let D=gn({},y[P.from],P,{key:_});D.valToPct=k(D),y[_]=D}else{b=y[_]=gn({},_==A?n_:zE,P),b.key=_;let D=b.time,V=b.range,K=Ys(V);if((_!=A||s==2&&!D)&&(K&&(V[0]==null||V[1]==null)&&(V={min:V[0]==null?n0:{mode:1,hard:V[0],soft:V[0]},max:V[1]==null?n0:{mode:1,hard:V[1],soft:V[1]}},K=!1),!K&&$h(V))){let le=V;V=(pe,Te,ze)=>Te==null?Ro:Vh(Te,ze,le)}b.range=At(V||(D?jE:_==A?b.distr==3?tT:b.distr==4?nT:d_:b.distr==3?f_:b.distr==4?p_:eT)),b.auto=At(K?!1:b.auto),b.clamp=At(b.clamp||kE),b._min=b._max=null,b.valToPct=k(b)}}}N("x"),N("y"),s==1&&S.forEach(_=>{N(_.scale)}),T.forEach(_=>{N(_.scale)});for(let _ in i.scales)N(_);let I=y[A],G=I.distr,W,L;I.ori==0?(hi(c,dw),W=r,L=o):(hi(c,fw),W=o,L=r);let H={};for(let _ in y){let b=y[_];(b.min!=null||b.max!=null)&&(H[_]={min:b.min,max:b.max},b.min=b.max=null)}let Y=i.tzDate||(_=>new Date(Sn(_/g))),z=i.fmtDate||Hf,ce=g==1?dE(Y):mE(Y),J=f0(Y,d0(g==1?uE:pE,z)),j=m0(Y,p0(_E,z)),te=[],fe=n.legend=gn({},yE,i.legend),he=n.cursor=gn({},TE,{drag:{y:s==2}},i.cursor),ee=fe.show,ge=he.show,ve=fe.markers;fe.idxs=te,ve.width=At(ve.width),ve.dash=At(ve.dash),ve.stroke=At(ve.stroke),ve.fill=At(ve.fill);let Ie,be,Ge,st=[],Je=[],rt,it=!1,oe={};if(fe.live){let _=S[1]?S[1].values:null;it=_!=null,rt=it?_(n,1,0):{_:0};for(let b in rt)oe[b]=Uf}if(ee)if(Ie=Ni("table",bw,c),Ge=Ni("tbody",null,Ie),fe.mount(n,Ie),it){be=Ni("thead",null,Ie,Ge);let _=Ni("tr",null,be);Ni("th",null,_);for(var xe in rt)Ni("th",Vg,_).textContent=xe}else hi(Ie,Ew),fe.live&&hi(Ie,ww);let _e={show:!0},Be={show:!1};function Le(_,b){if(b==0&&(it||!fe.live||s==2))return Ro;let P=[],D=Ni("tr",Tw,Ge,Ge.childNodes[b]);hi(D,_.class),_.show||hi(D,xr);let V=Ni("th",null,D);if(ve.show){let pe=vi(Aw,V);if(b>0){let Te=ve.width(n,b);Te&&(pe.style.border=Te+"px "+ve.dash(n,b)+" "+ve.stroke(n,b)),pe.style.background=ve.fill(n,b)}}let K=vi(Vg,V);_.label instanceof HTMLElement?K.appendChild(_.label):K.textContent=_.label,b>0&&(ve.show||(K.style.color=_.width>0?ve.stroke(n,b):ve.fill(n,b)),ke("click",V,pe=>{if(he._lock)return;lt(pe);let Te=S.indexOf(_);if((pe.ctrlKey||pe.metaKey)!=fe.isolate){let ze=S.some((He,We)=>We>0&&We!=Te&&He.show);S.forEach((He,We)=>{We>0&&zi(We,ze?We==Te?_e:Be:_e,!0,pn.setSeries)})}else zi(Te,{show:!_.show},!0,pn.setSeries)},!1),ct&&ke(Yg,V,pe=>{he._lock||(lt(pe),zi(S.indexOf(_),Nr,!0,pn.setSeries))},!1));for(var le in rt){let pe=Ni("td",Rw,D);pe.textContent="--",P.push(pe)}return[D,P]}let nt=new Map;function ke(_,b,P,D=!0){let V=nt.get(b)||{},K=he.bind[_](n,b,P,D);K&&(yr(_,b,V[_]=K),nt.set(b,V))}function gt(_,b,P){let D=nt.get(b)||{};for(let V in D)(_==null||V==_)&&(Af(V,b,D[V]),delete D[V]);_==null&&nt.delete(b)}let dt=0,vt=0,U=0,Se=0,Xe=0,ht=0,we=Xe,Nt=ht,$e=U,je=Se,R=0,M=0,q=0,de=0;n.bbox={};let ae=!1,Me=!1,Ee=!1,ne=!1,se=!1,me=!1;function O(_,b,P){(P||_!=n.width||b!=n.height)&&re(_,b),xt(!1),Ee=!0,Me=!0,Fn()}function re(_,b){n.width=dt=U=_,n.height=vt=Se=b,Xe=ht=0,Ae(),Ke();let P=n.bbox;R=P.left=_r(Xe*Dt,.5),M=P.top=_r(ht*Dt,.5),q=P.width=_r(U*Dt,.5),de=P.height=_r(Se*Dt,.5)}let ie=3;function Re(){let _=!1,b=0;for(;!_;){b++;let P=Rr(b),D=ki(b);_=b==ie||P&&D,_||(re(n.width,n.height),Me=!0)}}function ye({width:_,height:b}){O(_,b)}n.setSize=ye;function Ae(){let _=!1,b=!1,P=!1,D=!1;T.forEach((V,K)=>{if(V.show&&V._show){let{side:le,_size:pe}=V,Te=le%2,ze=V.label!=null?V.labelSize:0,He=pe+ze;He>0&&(Te?(U-=He,le==3?(Xe+=He,D=!0):P=!0):(Se-=He,le==0?(ht+=He,_=!0):b=!0))}}),Oi[0]=_,Oi[1]=P,Oi[2]=b,Oi[3]=D,U-=yi[1]+yi[3],Xe+=yi[3],Se-=yi[2]+yi[0],ht+=yi[0]}function Ke(){let _=Xe+U,b=ht+Se,P=Xe,D=ht;function V(K,le){switch(K){case 1:return _+=le,_-le;case 2:return b+=le,b-le;case 3:return P-=le,P+le;case 0:return D-=le,D+le}}T.forEach((K,le)=>{if(K.show&&K._show){let pe=K.side;K._pos=V(pe,K._size),K.label!=null&&(K._lpos=V(pe,K.labelSize))}})}if(he.dataIdx==null){let _=he.hover,b=_.skip=new Set(_.skip??[]);b.add(void 0);let P=_.prox=At(_.prox),D=_.bias??=0;he.dataIdx=(V,K,le,pe)=>{if(K==0)return le;let Te=le,ze=P(V,K,le,pe)??Gt,He=ze>=0&&ze<Gt,We=I.ori==0?U:Se,mt=he.left,It=e[0],Rt=e[K];if(b.has(Rt[le])){Te=null;let bt=null,ot=null,Qe;if(D==0||D==-1)for(Qe=le;bt==null&&Qe-- >0;)b.has(Rt[Qe])||(bt=Qe);if(D==0||D==1)for(Qe=le;ot==null&&Qe++<Rt.length;)b.has(Rt[Qe])||(ot=Qe);if(bt!=null||ot!=null)if(He){let $t=bt==null?-1/0:W(It[bt],I,We,0),an=ot==null?1/0:W(It[ot],I,We,0),An=mt-$t,Ht=an-mt;An<=Ht?An<=ze&&(Te=bt):Ht<=ze&&(Te=ot)}else Te=ot==null?bt:bt==null?ot:le-bt<=ot-le?bt:ot}else He&&Mn(mt-W(It[le],I,We,0))>ze&&(Te=null);return Te}}let lt=_=>{he.event=_};he.idxs=te,he._lock=!1;let ue=he.points;ue.show=At(ue.show),ue.size=At(ue.size),ue.stroke=At(ue.stroke),ue.width=At(ue.width),ue.fill=At(ue.fill);let qe=n.focus=gn({},i.focus||{alpha:.3},he.focus),ct=qe.prox>=0,Ne=ct&&ue.one,_t=[],Xt=[],Gn=[];function Fo(_,b){let P=ue.show(n,b);if(P instanceof HTMLElement)return hi(P,Mw),hi(P,_.class),ts(P,-10,-10,U,Se),p.insertBefore(P,_t[b]),P}function Er(_,b){if(s==1||b>0){let P=s==1&&y[_.scale].time,D=_.value;_.value=P?l0(D)?m0(Y,p0(D,z)):D||j:D||FE,_.label=_.label||(P?RE:AE)}if(Ne||b>0){_.width=_.width==null?1:_.width,_.paths=_.paths||JE||zw,_.fillTo=At(_.fillTo||HE),_.pxAlign=+Pt(_.pxAlign,x),_.pxRound=w0(_.pxAlign),_.stroke=At(_.stroke||null),_.fill=At(_.fill||null),_._stroke=_._fill=_._paths=_._focus=null;let P=OE(Qn(1,_.width),1),D=_.points=gn({},{size:P,width:Qn(1,P*.2),stroke:_.stroke,space:P*2,paths:KE,_stroke:null,_fill:null},_.points);D.show=At(D.show),D.filter=At(D.filter),D.fill=At(D.fill),D.stroke=At(D.stroke),D.paths=At(D.paths),D.pxAlign=_.pxAlign}if(ee){let P=Le(_,b);st.splice(b,0,P[0]),Je.splice(b,0,P[1]),fe.values.push(null)}if(ge){te.splice(b,0,null);let P=null;Ne?b==0&&(P=Fo(_,b)):b>0&&(P=Fo(_,b)),_t.splice(b,0,P),Xt.splice(b,0,0),Gn.splice(b,0,0)}Tn("addSeries",b)}function du(_,b){b=b??S.length,_=s==1?Df(_,b,_0,M0):Df(_,b,{},S0),S.splice(b,0,_),Er(S[b],b)}n.addSeries=du;function sl(_){if(S.splice(_,1),ee){fe.values.splice(_,1),Je.splice(_,1);let b=st.splice(_,1)[0];gt(null,b.firstChild),b.remove()}ge&&(te.splice(_,1),_t.splice(_,1)[0].remove(),Xt.splice(_,1),Gn.splice(_,1)),Tn("delSeries",_)}n.delSeries=sl;let Oi=[!1,!1,!1,!1];function ns(_,b){if(_._show=_.show,_.show){let P=_.side%2,D=y[_.scale];D==null&&(_.scale=P?S[1].scale:A,D=y[_.scale]);let V=D.time;_.size=At(_.size),_.space=At(_.space),_.rotate=At(_.rotate),Ys(_.incrs)&&_.incrs.forEach(le=>{!$s.has(le)&&$s.set(le,O0(le))}),_.incrs=At(_.incrs||(D.distr==2?lE:V?g==1?hE:fE:vr)),_.splits=At(_.splits||(V&&D.distr==1?ce:D.distr==3?Cf:D.distr==4?IE:PE)),_.stroke=At(_.stroke),_.grid.stroke=At(_.grid.stroke),_.ticks.stroke=At(_.ticks.stroke),_.border.stroke=At(_.border.stroke);let K=_.values;_.values=Ys(K)&&!Ys(K[0])?At(K):V?Ys(K)?f0(Y,d0(K,z)):l0(K)?gE(Y,K):K||J:K||CE,_.filter=At(_.filter||(D.distr>=3&&D.log==10?NE:D.distr==3&&D.log==2?UE:U0)),_.font=R0(_.font),_.labelFont=R0(_.labelFont),_._size=_.size(n,null,b,0),_._space=_._rotate=_._incrs=_._found=_._splits=_._values=null,_._size>0&&(Oi[b]=!0,_._el=vi(vw,u))}}function is(_,b,P,D){let[V,K,le,pe]=P,Te=b%2,ze=0;return Te==0&&(pe||K)&&(ze=b==0&&!V||b==2&&!le?Sn(g0.size/3):0),Te==1&&(V||le)&&(ze=b==1&&!K||b==3&&!pe?Sn(x0.size/2):0),ze}let Oo=n.padding=(i.padding||[is,is,is,is]).map(_=>At(Pt(_,is))),yi=n._padding=Oo.map((_,b)=>_(n,b,Oi,0)),rn,cn=null,hn=null,Bi=s==1?S[0].idxs:null,ei=null,Ms=!1;function Bo(_,b){if(e=_??[],n.data=n._data=e,s==2){rn=0;for(let P=1;P<S.length;P++)rn+=e[P][0].length}else{e.length==0&&(n.data=n._data=e=[[]]),ei=e[0],rn=ei.length;let P=e;if(G==2){P=e.slice();let D=P[0]=Array(rn);for(let V=0;V<rn;V++)D[V]=V}n._data=e=P}if(xt(!0),Tn("setData"),G==2&&(Ee=!0),b!==!1){let P=I;P.auto(n,Ms)?ko():Es(A,P.min,P.max),ne=ne||he.left>=0,me=!0,Fn()}}n.setData=Bo;function ko(){Ms=!0;let _,b;s==1&&(rn>0?(cn=Bi[0]=0,hn=Bi[1]=rn-1,_=e[0][cn],b=e[0][hn],G==2?(_=cn,b=hn):_==b&&(G==3?[_,b]=qh(_,_,I.log,!1):G==4?[_,b]=Of(_,_,I.log,!1):I.time?b=_+Sn(86400/g):[_,b]=Vh(_,b,Bf,!0))):(cn=Bi[0]=_=null,hn=Bi[1]=b=null)),Es(A,_,b)}let Tr,bs,Ar,w,B,Q,$,Z,Ce,Ue;function Pe(_,b,P,D,V,K){_??=Xg,P??=zf,D??="butt",V??=Xg,K??="round",_!=Tr&&(d.strokeStyle=Tr=_),V!=bs&&(d.fillStyle=bs=V),b!=Ar&&(d.lineWidth=Ar=b),K!=B&&(d.lineJoin=B=K),D!=Q&&(d.lineCap=Q=D),P!=w&&d.setLineDash(w=P)}function Fe(_,b,P,D){b!=bs&&(d.fillStyle=bs=b),_!=$&&(d.font=$=_),P!=Z&&(d.textAlign=Z=P),D!=Ce&&(d.textBaseline=Ce=D)}function Ze(_,b,P,D,V=0){if(D.length>0&&_.auto(n,Ms)&&(b==null||b.min==null)){let K=Pt(cn,0),le=Pt(hn,D.length-1),pe=P.min==null?Nw(D,K,le,V,_.distr==3):[P.min,P.max];_.min=Fi(_.min,P.min=pe[0]),_.max=Qn(_.max,P.max=pe[1])}}let ut={min:null,max:null};function St(){for(let D in y){let V=y[D];H[D]==null&&(V.min==null||H[A]!=null&&V.auto(n,Ms))&&(H[D]=ut)}for(let D in y){let V=y[D];H[D]==null&&V.from!=null&&H[V.from]!=null&&(H[D]=ut)}H[A]!=null&&xt(!0);let _={};for(let D in H){let V=H[D];if(V!=null){let K=_[D]=Co(y[D],Vw);if(V.min!=null)gn(K,V);else if(D!=A||s==2)if(rn==0&&K.from==null){let le=K.range(n,null,null,D);K.min=le[0],K.max=le[1]}else K.min=Gt,K.max=-Gt}}if(rn>0){S.forEach((D,V)=>{if(s==1){let K=D.scale,le=H[K];if(le==null)return;let pe=_[K];if(V==0){let Te=pe.range(n,pe.min,pe.max,K);pe.min=Te[0],pe.max=Te[1],cn=Ui(pe.min,e[0]),hn=Ui(pe.max,e[0]),hn-cn>1&&(e[0][cn]<pe.min&&cn++,e[0][hn]>pe.max&&hn--),D.min=ei[cn],D.max=ei[hn]}else D.show&&D.auto&&Ze(pe,le,D,e[V],D.sorted);D.idxs[0]=cn,D.idxs[1]=hn}else if(V>0&&D.show&&D.auto){let[K,le]=D.facets,pe=K.scale,Te=le.scale,[ze,He]=e[V],We=_[pe],mt=_[Te];We!=null&&Ze(We,H[pe],K,ze,K.sorted),mt!=null&&Ze(mt,H[Te],le,He,le.sorted),D.min=le.min,D.max=le.max}});for(let D in _){let V=_[D],K=H[D];if(V.from==null&&(K==null||K.min==null)){let le=V.range(n,V.min==Gt?null:V.min,V.max==-Gt?null:V.max,D);V.min=le[0],V.max=le[1]}}}for(let D in _){let V=_[D];if(V.from!=null){let K=_[V.from];if(K.min==null)V.min=V.max=null;else{let le=V.range(n,K.min,K.max,D);V.min=le[0],V.max=le[1]}}}let b={},P=!1;for(let D in _){let V=_[D],K=y[D];if(K.min!=V.min||K.max!=V.max){K.min=V.min,K.max=V.max;let le=K.distr;K._min=le==3?ys(K.min):le==4?yf(K.min,K.asinh):le==100?K.fwd(K.min):K.min,K._max=le==3?ys(K.max):le==4?yf(K.max,K.asinh):le==100?K.fwd(K.max):K.max,b[D]=P=!0}}if(P){S.forEach((D,V)=>{s==2?V>0&&b.y&&(D._paths=null):b[D.scale]&&(D._paths=null)});for(let D in b)Ee=!0,Tn("setScale",D);ge&&he.left>=0&&(ne=me=!0)}for(let D in H)H[D]=null}function Ye(_){let b=Rf(cn-1,0,rn-1),P=Rf(hn+1,0,rn-1);for(;_[b]==null&&b>0;)b--;for(;_[P]==null&&P<rn-1;)P++;return[b,P]}function Mt(){if(rn>0){let _=S.some(b=>b._focus)&&Ue!=qe.alpha;_&&(d.globalAlpha=Ue=qe.alpha),S.forEach((b,P)=>{if(P>0&&b.show&&(nn(P,!1),nn(P,!0),b._paths==null)){let D=Ue;Ue!=b.alpha&&(d.globalAlpha=Ue=b.alpha);let V=s==2?[0,e[P][0].length-1]:Ye(e[P]);b._paths=b.paths(n,P,V[0],V[1]),Ue!=D&&(d.globalAlpha=Ue=D)}}),S.forEach((b,P)=>{if(P>0&&b.show){let D=Ue;Ue!=b.alpha&&(d.globalAlpha=Ue=b.alpha),b._paths!=null&&Bt(P,!1);{let V=b._paths!=null?b._paths.gaps:null,K=b.points.show(n,P,cn,hn,V),le=b.points.filter(n,P,K,V);(K||le)&&(b.points._paths=b.points.paths(n,P,cn,hn,le),Bt(P,!0))}Ue!=D&&(d.globalAlpha=Ue=D),Tn("drawSeries",P)}}),_&&(d.globalAlpha=Ue=1)}}function nn(_,b){let P=b?S[_].points:S[_];P._stroke=P.stroke(n,_),P._fill=P.fill(n,_)}function Bt(_,b){let P=b?S[_].points:S[_],{stroke:D,fill:V,clip:K,flags:le,_stroke:pe=P._stroke,_fill:Te=P._fill,_width:ze=P.width}=P._paths;ze=Vt(ze*Dt,3);let He=null,We=ze%2/2;b&&Te==null&&(Te=ze>0?"#fff":pe);let mt=P.pxAlign==1&&We>0;if(mt&&d.translate(We,We),!b){let It=R-ze/2,Rt=M-ze/2,bt=q+ze,ot=de+ze;He=new Path2D,He.rect(It,Rt,bt,ot)}b?Ve(pe,ze,P.dash,P.cap,Te,D,V,le,K):kt(_,pe,ze,P.dash,P.cap,Te,D,V,le,He,K),mt&&d.translate(-We,-We)}function kt(_,b,P,D,V,K,le,pe,Te,ze,He){let We=!1;Te!=0&&C.forEach((mt,It)=>{if(mt.series[0]==_){let Rt=S[mt.series[1]],bt=e[mt.series[1]],ot=(Rt._paths||el).band;Ys(ot)&&(ot=mt.dir==1?ot[0]:ot[1]);let Qe,$t=null;Rt.show&&ot&&Fw(bt,cn,hn)?($t=mt.fill(n,It)||K,Qe=Rt._paths.clip):ot=null,Ve(b,P,D,V,$t,le,pe,Te,ze,He,Qe,ot),We=!0}}),We||Ve(b,P,D,V,K,le,pe,Te,ze,He)}let _n=Po|If;function Ve(_,b,P,D,V,K,le,pe,Te,ze,He,We){Pe(_,b,P,D,V),(Te||ze||We)&&(d.save(),Te&&d.clip(Te),ze&&d.clip(ze)),We?(pe&_n)==_n?(d.clip(We),He&&d.clip(He),Et(V,le),un(_,K,b)):pe&If?(Et(V,le),d.clip(We),un(_,K,b)):pe&Po&&(d.save(),d.clip(We),He&&d.clip(He),Et(V,le),d.restore(),un(_,K,b)):(Et(V,le),un(_,K,b)),(Te||ze||We)&&d.restore()}function un(_,b,P){P>0&&(b instanceof Map?b.forEach((D,V)=>{d.strokeStyle=Tr=V,d.stroke(D)}):b!=null&&_&&d.stroke(b))}function Et(_,b){b instanceof Map?b.forEach((P,D)=>{d.fillStyle=bs=D,d.fill(P)}):b!=null&&_&&d.fill(b)}function ss(_,b,P,D){let V=T[_],K;if(D<=0)K=[0,0];else{let le=V._space=V.space(n,_,b,P,D),pe=V._incrs=V.incrs(n,_,b,P,D,le);K=iT(b,P,pe,D,le)}return V._found=K}function dn(_,b,P,D,V,K,le,pe,Te,ze){let He=le%2/2;x==1&&d.translate(He,He),Pe(pe,le,Te,ze,pe),d.beginPath();let We,mt,It,Rt,bt=V+(D==0||D==3?-K:K);P==0?(mt=V,Rt=bt):(We=V,It=bt);for(let ot=0;ot<_.length;ot++)b[ot]!=null&&(P==0?We=It=_[ot]:mt=Rt=_[ot],d.moveTo(We,mt),d.lineTo(It,Rt));d.stroke(),x==1&&d.translate(-He,-He)}function Rr(_){let b=!0;return T.forEach((P,D)=>{if(!P.show)return;let V=y[P.scale];if(V.min==null){P._show&&(b=!1,P._show=!1,xt(!1));return}else P._show||(b=!1,P._show=!0,xt(!1));let K=P.side,le=K%2,{min:pe,max:Te}=V,[ze,He]=ss(D,pe,Te,le==0?U:Se);if(He==0)return;let We=V.distr==2,mt=P._splits=P.splits(n,D,pe,Te,ze,He,We),It=V.distr==2?mt.map(Qe=>ei[Qe]):mt,Rt=V.distr==2?ei[mt[1]]-ei[mt[0]]:ze,bt=P._values=P.values(n,P.filter(n,It,D,He,Rt),D,He,Rt);P._rotate=K==2?P.rotate(n,bt,D,He):0;let ot=P._size;P._size=xi(P.size(n,bt,D,_)),ot!=null&&P._size!=ot&&(b=!1)}),b}function ki(_){let b=!0;return Oo.forEach((P,D)=>{let V=P(n,D,Oi,_);V!=yi[D]&&(b=!1),yi[D]=V}),b}function rs(){for(let _=0;_<T.length;_++){let b=T[_];if(!b.show||!b._show)continue;let P=b.side,D=P%2,V,K,le=b.stroke(n,_),pe=P==0||P==3?-1:1,[Te,ze]=b._found;if(b.label!=null){let Xn=b.labelGap*pe,ii=Sn((b._lpos+Xn)*Dt);Fe(b.labelFont[0],le,"center",P==2?"top":Wg),d.save(),D==1?(V=K=0,d.translate(ii,Sn(M+de/2)),d.rotate((P==3?-Hh:Hh)/2)):(V=Sn(R+q/2),K=ii);let Ks=D0(b.label)?b.label(n,_,Te,ze):b.label;d.fillText(Ks,V,K),d.restore()}if(ze==0)continue;let He=y[b.scale],We=D==0?q:de,mt=D==0?R:M,It=b._splits,Rt=He.distr==2?It.map(Xn=>ei[Xn]):It,bt=He.distr==2?ei[It[1]]-ei[It[0]]:Te,ot=b.ticks,Qe=b.border,$t=ot.show?ot.size:0,an=Sn($t*Dt),An=Sn((b.alignTo==2?b._size-$t-b.gap:b.gap)*Dt),Ht=b._rotate*-Hh/180,ln=m(b._pos*Dt),ti=(an+An)*pe,Wn=ln+ti;K=D==0?Wn:0,V=D==1?Wn:0;let fi=b.font[0],Si=b.align==1?wo:b.align==2?_f:Ht>0?wo:Ht<0?_f:D==0?"center":P==3?_f:wo,Gi=Ht||D==1?"middle":P==2?"top":Wg;Fe(fi,le,Si,Gi);let ni=b.font[1]*b.lineGap,pi=It.map(Xn=>m(a(Xn,He,We,mt))),Mi=b._values;for(let Xn=0;Xn<Mi.length;Xn++){let ii=Mi[Xn];if(ii!=null){D==0?V=pi[Xn]:K=pi[Xn],ii=""+ii;let Ks=ii.indexOf(`
`)==-1?[ii]:ii.split(/\n/gm);for(let qn=0;qn<Ks.length;qn++){let yp=Ks[qn];Ht?(d.save(),d.translate(V,K+qn*ni),d.rotate(Ht),d.fillText(yp,0,0),d.restore()):d.fillText(yp,V,K+qn*ni)}}}ot.show&&dn(pi,ot.filter(n,Rt,_,ze,bt),D,P,ln,an,Vt(ot.width*Dt,3),ot.stroke(n,_),ot.dash,ot.cap);let Vi=b.grid;Vi.show&&dn(pi,Vi.filter(n,Rt,_,ze,bt),D,D==0?2:1,D==0?M:R,D==0?de:q,Vt(Vi.width*Dt,3),Vi.stroke(n,_),Vi.dash,Vi.cap),Qe.show&&dn([ln],[1],D==0?1:0,D==0?1:2,D==1?M:R,D==1?de:q,Vt(Qe.width*Dt,3),Qe.stroke(n,_),Qe.dash,Qe.cap)}Tn("drawAxes")}function xt(_){S.forEach((b,P)=>{P>0&&(b._paths=null,_&&(s==1?(b.min=null,b.max=null):b.facets.forEach(D=>{D.min=null,D.max=null})))})}let on=!1,Vn=!1,zt=[];function fn(){Vn=!1;for(let _=0;_<zt.length;_++)Tn(...zt[_]);zt.length=0}function Fn(){on||(Jw(np),on=!0)}function rl(_,b=!1){on=!0,Vn=b,_(n),np(),b&&zt.length>0&&queueMicrotask(fn)}n.batch=rl;function np(){if(ae&&(St(),ae=!1),Ee&&(Re(),Ee=!1),Me){if(Kt(f,wo,Xe),Kt(f,"top",ht),Kt(f,Ja,U),Kt(f,Ka,Se),Kt(p,wo,Xe),Kt(p,"top",ht),Kt(p,Ja,U),Kt(p,Ka,Se),Kt(u,Ja,dt),Kt(u,Ka,vt),h.width=Sn(dt*Dt),h.height=Sn(vt*Dt),T.forEach(({_el:_,_show:b,_size:P,_pos:D,side:V})=>{if(_!=null)if(b){let K=V===3||V===0?P:0,le=V%2==1;Kt(_,le?"left":"top",D-K),Kt(_,le?"width":"height",P),Kt(_,le?"top":"left",le?ht:Xe),Kt(_,le?"height":"width",le?Se:U),Tf(_,xr)}else hi(_,xr)}),Tr=bs=Ar=B=Q=$=Z=Ce=w=null,Ue=1,Go(!0),Xe!=we||ht!=Nt||U!=$e||Se!=je){xt(!1);let _=U/$e,b=Se/je;if(ge&&!ne&&he.left>=0){he.left*=_,he.top*=b,Cr&&ts(Cr,Sn(he.left),0,U,Se),Pr&&ts(Pr,0,Sn(he.top),U,Se);for(let P=0;P<_t.length;P++){let D=_t[P];D!=null&&(Xt[P]*=_,Gn[P]*=b,ts(D,xi(Xt[P]),xi(Gn[P]),U,Se))}}if(Yt.show&&!se&&Yt.left>=0&&Yt.width>0){Yt.left*=_,Yt.width*=_,Yt.top*=b,Yt.height*=b;for(let P in vu)Kt(Dr,P,Yt[P])}we=Xe,Nt=ht,$e=U,je=Se}Tn("setSize"),Me=!1}dt>0&&vt>0&&(d.clearRect(0,0,h.width,h.height),Tn("drawClear"),E.forEach(_=>_()),Tn("draw")),Yt.show&&se&&(ol(Yt),se=!1),ge&&ne&&(Js(null,!0,!1),ne=!1),fe.show&&fe.live&&me&&(gu(),me=!1),l||(l=!0,n.status=1,Tn("ready")),Ms=!1,on=!1}n.redraw=(_,b)=>{Ee=b||!1,_!==!1?Es(A,I.min,I.max):Fn()};function fu(_,b){let P=y[_];if(P.from==null){if(rn==0){let D=P.range(n,b.min,b.max,_);b.min=D[0],b.max=D[1]}if(b.min>b.max){let D=b.min;b.min=b.max,b.max=D}if(rn>1&&b.min!=null&&b.max!=null&&b.max-b.min<1e-16)return;_==A&&P.distr==2&&rn>0&&(b.min=Ui(b.min,e[0]),b.max=Ui(b.max,e[0]),b.min==b.max&&b.max++),H[_]=b,ae=!0,Fn()}}n.setScale=fu;let pu,mu,Cr,Pr,ip,sp,Ir,Lr,rp,op,qt,Qt,ws=!1,Dn=he.drag,wn=Dn.x,En=Dn.y;ge&&(he.x&&(pu=vi(yw,p)),he.y&&(mu=vi(Sw,p)),I.ori==0?(Cr=pu,Pr=mu):(Cr=mu,Pr=pu),qt=he.left,Qt=he.top);let Yt=n.select=gn({show:!0,over:!0,left:0,width:0,top:0,height:0},i.select),Dr=Yt.show?vi(xw,Yt.over?p:f):null;function ol(_,b){if(Yt.show){for(let P in _)Yt[P]=_[P],P in vu&&Kt(Dr,P,_[P]);b!==!1&&Tn("setSelect")}}n.setSelect=ol;function P_(_){if(S[_].show)ee&&Tf(st[_],xr);else if(ee&&hi(st[_],xr),ge){let P=Ne?_t[0]:_t[_];P!=null&&ts(P,-10,-10,U,Se)}}function Es(_,b,P){fu(_,{min:b,max:P})}function zi(_,b,P,D){b.focus!=null&&U_(_),b.show!=null&&S.forEach((V,K)=>{K>0&&(_==K||_==null)&&(V.show=b.show,P_(K),s==2?(Es(V.facets[0].scale,null,null),Es(V.facets[1].scale,null,null)):Es(V.scale,null,null),Fn())}),P!==!1&&Tn("setSeries",_,b),D&&Vo("setSeries",n,_,b)}n.setSeries=zi;function I_(_,b){gn(C[_],b)}function L_(_,b){_.fill=At(_.fill||null),_.dir=Pt(_.dir,-1),b=b??C.length,C.splice(b,0,_)}function D_(_){_==null?C.length=0:C.splice(_,1)}n.addBand=L_,n.setBand=I_,n.delBand=D_;function N_(_,b){S[_].alpha=b,ge&&_t[_]!=null&&(_t[_].style.opacity=b),ee&&st[_]&&(st[_].style.opacity=b)}let os,Ts,Zs,Nr={focus:!0};function U_(_){if(_!=Zs){let b=_==null,P=qe.alpha!=1;S.forEach((D,V)=>{if(s==1||V>0){let K=b||V==0||V==_;D._focus=b?null:K,P&&N_(V,K?1:qe.alpha)}}),Zs=_,P&&Fn()}}ee&&ct&&ke($g,Ie,_=>{he._lock||(lt(_),Zs!=null&&zi(null,Nr,!0,pn.setSeries))});function Hi(_,b,P){let D=y[b];P&&(_=_/Dt-(D.ori==1?ht:Xe));let V=U;D.ori==1&&(V=Se,_=V-_),D.dir==-1&&(_=V-_);let K=D._min,le=D._max,pe=_/V,Te=K+(le-K)*pe,ze=D.distr;return ze==3?Ao(10,Te):ze==4?Bw(Te,D.asinh):ze==100?D.bwd(Te):Te}function F_(_,b){let P=Hi(_,A,b);return Ui(P,e[0],cn,hn)}n.valToIdx=_=>Ui(_,e[0]),n.posToIdx=F_,n.posToVal=Hi,n.valToPos=(_,b,P)=>y[b].ori==0?r(_,y[b],P?q:U,P?R:0):o(_,y[b],P?de:Se,P?M:0),n.setCursor=(_,b,P)=>{qt=_.left,Qt=_.top,Js(null,b,P)};function ap(_,b){Kt(Dr,wo,Yt.left=_),Kt(Dr,Ja,Yt.width=b)}function lp(_,b){Kt(Dr,"top",Yt.top=_),Kt(Dr,Ka,Yt.height=b)}let zo=I.ori==0?ap:lp,Ho=I.ori==1?ap:lp;function O_(){if(ee&&fe.live)for(let _=s==2?1:0;_<S.length;_++){if(_==0&&it)continue;let b=fe.values[_],P=0;for(let D in b)Je[_][P++].firstChild.nodeValue=b[D]}}function gu(_,b){if(_!=null&&(_.idxs?_.idxs.forEach((P,D)=>{te[D]=P}):Gw(_.idx)||te.fill(_.idx),fe.idx=te[0]),ee&&fe.live){for(let P=0;P<S.length;P++)(P>0||s==1&&!it)&&B_(P,te[P]);O_()}me=!1,b!==!1&&Tn("setLegend")}n.setLegend=gu;function B_(_,b){let P=S[_],D=_==0&&G==2?ei:e[_],V;it?V=P.values(n,_,b)??oe:(V=P.value(n,b==null?null:D[b],_,b),V=V==null?oe:{_:V}),fe.values[_]=V}function Js(_,b,P){rp=qt,op=Qt,[qt,Qt]=he.move(n,qt,Qt),he.left=qt,he.top=Qt,ge&&(Cr&&ts(Cr,Sn(qt),0,U,Se),Pr&&ts(Pr,0,Sn(Qt),U,Se));let D,V=cn>hn;os=Gt,Ts=null;let K=I.ori==0?U:Se,le=I.ori==1?U:Se;if(qt<0||rn==0||V){D=he.idx=null;for(let pe=0;pe<S.length;pe++){let Te=_t[pe];Te!=null&&ts(Te,-10,-10,U,Se)}ct&&zi(null,Nr,!0,_==null&&pn.setSeries),fe.live&&(te.fill(D),me=!0)}else{let pe,Te,ze;s==1&&(pe=I.ori==0?qt:Qt,Te=Hi(pe,A),D=he.idx=Ui(Te,e[0],cn,hn),ze=W(e[0][D],I,K,0));let He=-10,We=-10,mt=0,It=0,Rt=!0,bt="",ot="";for(let Qe=s==2?1:0;Qe<S.length;Qe++){let $t=S[Qe],an=te[Qe],An=an==null?null:s==1?e[Qe][an]:e[Qe][1][an],Ht=he.dataIdx(n,Qe,D,Te),ln=Ht==null?null:s==1?e[Qe][Ht]:e[Qe][1][Ht];if(me=me||ln!=An||Ht!=an,te[Qe]=Ht,Qe>0&&$t.show){let ti=Ht==null?-10:Ht==D?ze:W(s==1?e[0][Ht]:e[Qe][0][Ht],I,K,0),Wn=ln==null?-10:L(ln,s==1?y[$t.scale]:y[$t.facets[1].scale],le,0);if(ct&&ln!=null){let fi=I.ori==1?qt:Qt,Si=Mn(qe.dist(n,Qe,Ht,Wn,fi));if(Si<os){let Gi=qe.bias;if(Gi!=0){let ni=Hi(fi,$t.scale),pi=ln>=0?1:-1,Mi=ni>=0?1:-1;Mi==pi&&(Mi==1?Gi==1?ln>=ni:ln<=ni:Gi==1?ln<=ni:ln>=ni)&&(os=Si,Ts=Qe)}else os=Si,Ts=Qe}}if(me||Ne){let fi,Si;I.ori==0?(fi=ti,Si=Wn):(fi=Wn,Si=ti);let Gi,ni,pi,Mi,Vi,Xn,ii=!0,Ks=ue.bbox;if(Ks!=null){ii=!1;let qn=Ks(n,Qe);pi=qn.left,Mi=qn.top,Gi=qn.width,ni=qn.height}else pi=fi,Mi=Si,Gi=ni=ue.size(n,Qe);if(Xn=ue.fill(n,Qe),Vi=ue.stroke(n,Qe),Ne)Qe==Ts&&os<=qe.prox&&(He=pi,We=Mi,mt=Gi,It=ni,Rt=ii,bt=Xn,ot=Vi);else{let qn=_t[Qe];qn!=null&&(Xt[Qe]=pi,Gn[Qe]=Mi,t0(qn,Gi,ni,ii),jg(qn,Xn,Vi),ts(qn,xi(pi),xi(Mi),U,Se))}}}}if(Ne){let Qe=qe.prox,$t=Zs==null?os<=Qe:os>Qe||Ts!=Zs;if(me||$t){let an=_t[0];an!=null&&(Xt[0]=He,Gn[0]=We,t0(an,mt,It,Rt),jg(an,bt,ot),ts(an,xi(He),xi(We),U,Se))}}}if(Yt.show&&ws)if(_!=null){let[pe,Te]=pn.scales,[ze,He]=pn.match,[We,mt]=_.cursor.sync.scales,It=_.cursor.drag;if(wn=It._x,En=It._y,wn||En){let{left:Rt,top:bt,width:ot,height:Qe}=_.select,$t=_.scales[We].ori,an=_.posToVal,An,Ht,ln,ti,Wn,fi=pe!=null&&ze(pe,We),Si=Te!=null&&He(Te,mt);fi&&wn?($t==0?(An=Rt,Ht=ot):(An=bt,Ht=Qe),ln=y[pe],ti=W(an(An,We),ln,K,0),Wn=W(an(An+Ht,We),ln,K,0),zo(Fi(ti,Wn),Mn(Wn-ti))):zo(0,K),Si&&En?($t==1?(An=Rt,Ht=ot):(An=bt,Ht=Qe),ln=y[Te],ti=L(an(An,mt),ln,le,0),Wn=L(an(An+Ht,mt),ln,le,0),Ho(Fi(ti,Wn),Mn(Wn-ti))):Ho(0,le)}else xu()}else{let pe=Mn(rp-ip),Te=Mn(op-sp);if(I.ori==1){let mt=pe;pe=Te,Te=mt}wn=Dn.x&&pe>=Dn.dist,En=Dn.y&&Te>=Dn.dist;let ze=Dn.uni;ze!=null?wn&&En&&(wn=pe>=ze,En=Te>=ze,!wn&&!En&&(Te>pe?En=!0:wn=!0)):Dn.x&&Dn.y&&(wn||En)&&(wn=En=!0);let He,We;wn&&(I.ori==0?(He=Ir,We=qt):(He=Lr,We=Qt),zo(Fi(He,We),Mn(We-He)),En||Ho(0,le)),En&&(I.ori==1?(He=Ir,We=qt):(He=Lr,We=Qt),Ho(Fi(He,We),Mn(We-He)),wn||zo(0,K)),!wn&&!En&&(zo(0,0),Ho(0,0))}if(Dn._x=wn,Dn._y=En,_==null){if(P){if(xp!=null){let[pe,Te]=pn.scales;pn.values[0]=pe!=null?Hi(I.ori==0?qt:Qt,pe):null,pn.values[1]=Te!=null?Hi(I.ori==1?qt:Qt,Te):null}Vo(vf,n,qt,Qt,U,Se,D)}if(ct){let pe=P&&pn.setSeries,Te=qe.prox;Zs==null?os<=Te&&zi(Ts,Nr,!0,pe):os>Te?zi(null,Nr,!0,pe):Ts!=Zs&&zi(Ts,Nr,!0,pe)}}me&&(fe.idx=D,gu()),b!==!1&&Tn("setCursor")}let As=null;Object.defineProperty(n,"rect",{get(){return As==null&&Go(!1),As}});function Go(_=!1){_?As=null:(As=p.getBoundingClientRect(),Tn("syncRect",As))}function cp(_,b,P,D,V,K,le){he._lock||ws&&_!=null&&_.movementX==0&&_.movementY==0||(_u(_,b,P,D,V,K,le,!1,_!=null),_!=null?Js(null,!0,!0):Js(b,!0,!1))}function _u(_,b,P,D,V,K,le,pe,Te){if(As==null&&Go(!1),lt(_),_!=null)P=_.clientX-As.left,D=_.clientY-As.top;else{if(P<0||D<0){qt=-10,Qt=-10;return}let[ze,He]=pn.scales,We=b.cursor.sync,[mt,It]=We.values,[Rt,bt]=We.scales,[ot,Qe]=pn.match,$t=b.axes[0].side%2==1,an=I.ori==0?U:Se,An=I.ori==1?U:Se,Ht=$t?K:V,ln=$t?V:K,ti=$t?D:P,Wn=$t?P:D;if(Rt!=null?P=ot(ze,Rt)?a(mt,y[ze],an,0):-10:P=an*(ti/Ht),bt!=null?D=Qe(He,bt)?a(It,y[He],An,0):-10:D=An*(Wn/ln),I.ori==1){let fi=P;P=D,D=fi}}Te&&(b==null||b.cursor.event.type==vf)&&((P<=1||P>=U-1)&&(P=_r(P,U)),(D<=1||D>=Se-1)&&(D=_r(D,Se))),pe?(ip=P,sp=D,[Ir,Lr]=he.move(n,P,D)):(qt=P,Qt=D)}let vu={width:0,height:0,left:0,top:0};function xu(){ol(vu,!1)}let hp,up,dp,fp;function pp(_,b,P,D,V,K,le){ws=!0,wn=En=Dn._x=Dn._y=!1,_u(_,b,P,D,V,K,le,!0,!1),_!=null&&(ke(xf,wf,mp,!1),Vo(qg,n,Ir,Lr,U,Se,null));let{left:pe,top:Te,width:ze,height:He}=Yt;hp=pe,up=Te,dp=ze,fp=He}function mp(_,b,P,D,V,K,le){ws=Dn._x=Dn._y=!1,_u(_,b,P,D,V,K,le,!1,!0);let{left:pe,top:Te,width:ze,height:He}=Yt,We=ze>0||He>0,mt=hp!=pe||up!=Te||dp!=ze||fp!=He;if(We&&mt&&ol(Yt),Dn.setScale&&We&&mt){let It=pe,Rt=ze,bt=Te,ot=He;if(I.ori==1&&(It=Te,Rt=He,bt=pe,ot=ze),wn&&Es(A,Hi(It,A),Hi(It+Rt,A)),En)for(let Qe in y){let $t=y[Qe];Qe!=A&&$t.from==null&&$t.min!=Gt&&Es(Qe,Hi(bt+ot,Qe),Hi(bt,Qe))}xu()}else he.lock&&(he._lock=!he._lock,Js(b,!0,_!=null));_!=null&&(gt(xf,wf),Vo(xf,n,qt,Qt,U,Se,null))}function k_(_,b,P,D,V,K,le){if(he._lock)return;lt(_);let pe=ws;if(ws){let Te=!0,ze=!0,He=10,We,mt;I.ori==0?(We=wn,mt=En):(We=En,mt=wn),We&&mt&&(Te=qt<=He||qt>=U-He,ze=Qt<=He||Qt>=Se-He),We&&Te&&(qt=qt<Ir?0:U),mt&&ze&&(Qt=Qt<Lr?0:Se),Js(null,!0,!0),ws=!1}qt=-10,Qt=-10,te.fill(null),Js(null,!0,!0),pe&&(ws=pe)}function gp(_,b,P,D,V,K,le){he._lock||(lt(_),ko(),xu(),_!=null&&Vo(Zg,n,qt,Qt,U,Se,null))}function _p(){T.forEach(sT),O(n.width,n.height,!0)}yr(Gh,To,_p);let Ur={};Ur.mousedown=pp,Ur.mousemove=cp,Ur.mouseup=mp,Ur.dblclick=gp,Ur.setSeries=(_,b,P,D)=>{let V=pn.match[2];P=V(n,b,P),P!=-1&&zi(P,D,!0,!1)},ge&&(ke(qg,p,pp),ke(vf,p,cp),ke(Yg,p,_=>{lt(_),Go(!1)}),ke($g,p,k_),ke(Zg,p,gp),Lf.add(n),n.syncRect=Go);let al=n.hooks=i.hooks||{};function Tn(_,b,P){Vn?zt.push([_,b,P]):_ in al&&al[_].forEach(D=>{D.call(null,n,b,P)})}(i.plugins||[]).forEach(_=>{for(let b in _.hooks)al[b]=(al[b]||[]).concat(_.hooks[b])});let vp=(_,b,P)=>P,pn=gn({key:null,setSeries:!1,filters:{pub:o0,sub:o0},scales:[A,S[1]?S[1].scale:null],match:[a0,a0,vp],values:[null,null]},he.sync);pn.match.length==2&&pn.match.push(vp),he.sync=pn;let xp=pn.key,yu=i_(xp);function Vo(_,b,P,D,V,K,le){pn.filters.pub(_,b,P,D,V,K,le)&&yu.pub(_,b,P,D,V,K,le)}yu.sub(n);function z_(_,b,P,D,V,K,le){pn.filters.sub(_,b,P,D,V,K,le)&&Ur[_](null,b,P,D,V,K,le)}n.pub=z_;function H_(){yu.unsub(n),Lf.delete(n),nt.clear(),Af(Gh,To,_p),c.remove(),Ie?.remove(),Tn("destroy")}n.destroy=H_;function Su(){Tn("init",i,e),Bo(e||i.data,!1),H[A]?fu(A,H[A]):ko(),se=Yt.show&&(Yt.width>0||Yt.height>0),ne=me=!0,O(i.width,i.height)}return S.forEach(Er),T.forEach(ns),t?t instanceof HTMLElement?(t.appendChild(c),Su()):t(n,Su):Su(),n}bn.assign=gn;bn.fmtNum=kf;bn.rangeNum=Vh;bn.rangeLog=qh;bn.rangeAsinh=Of;bn.orient=Mr;bn.pxRatio=Dt;bn.join=Zw;bn.fmtDate=Hf,bn.tzDate=oE;bn.sync=i_;{bn.addGap=GE,bn.clipGaps=Zh;let i=bn.paths={points:c_};i.linear=u_,i.stepped=XE,i.bars=qE,i.spline=$E}var g_=46,nl=class{constructor(e,t){this.spec=e;this.sync=t;this.values=e.lines.map(()=>F("b")),this.element=F("section",{class:e.foot?"chart foot":"chart","aria-label":`${e.title} over time, ${e.unit}`},F("header",{},F("h3",{},e.title),F("span",{class:"unit"},e.unit),F("span",{class:"values"},...e.lines.map((n,s)=>{let r=F("span",{class:"value"},F("i",{class:n.dashed?"key dashed":"key"}),e.lines.length>1?`${n.label} `:"",this.values[s]);return r.firstElementChild.style.setProperty("--key",`var(${n.colour})`),r}))),this.holder)}spec;sync;element;plot=null;values;holder=F("div",{class:"plot"});stretches=[];range=[0,1];data=[[]];branch;mark=null;fit(){let{clientWidth:e,clientHeight:t}=this.holder;!e||!t||(this.plot?this.plot.setSize({width:e,height:t}):this.plot=new bn(this.options(e,t),this.data,this.holder))}recolour(){this.destroy(),this.fit()}destroy(){this.plot?.destroy(),this.plot=null}set(e,t,n,s=null){this.mark=s,this.data=e,this.branch=this.spec.turn&&cT(e,this.spec),this.range=t,this.stretches=n,this.plot?.setData(e),this.showValues()}get ends(){let{min:e,max:t}=this.plot?.scales.y??{};return e==null||t==null?null:[e,t]}showValues(){let e=this.plot?.cursor.idx,t=this.data[0].length-1,n=e??(this.mark===null?t:rT(this.data[0],this.mark)),s=this.spec.bands?3:1;this.values.forEach((r,o)=>{let a=this.data[1+o*s]?.[n];et(r,en(this.named(a??NaN),this.spec.digits))})}options(e,t){let{spec:n}=this,[s,r]=[jt("--muted"),jt("--line")],o=n.turn?{gaps:uT}:{},a=[{}],l=[];for(let h of n.lines){let d=jt(h.colour);if(a.push({stroke:d,width:1.5,dash:h.dashed?[5,3]:void 0,points:{show:!1},spanGaps:!1,...o}),!!n.bands){for(let u=0;u<2;u++)a.push({stroke:"transparent",width:0,points:{show:!1},...o});l.push({series:[a.length-2,a.length-1],fill:d+"2e"})}}let c={stroke:r,width:1};return{width:e,height:t,series:a,bands:l,legend:{show:!1},padding:[6,4,0,0],cursor:{sync:{key:this.sync.key,setSeries:!1,scales:["x",null]},drag:{x:!1,y:!1},points:{size:5},y:!1},scales:{x:{time:this.mark===null,range:()=>this.range},y:{range:(h,d,u)=>dT(d,u,n.least,this.branch)}},axes:[{stroke:s,grid:c,ticks:{show:!1},size:n.foot?22:4,font:m_,values:(h,d)=>n.foot?this.times(h,d):[],space:70},{stroke:s,grid:c,ticks:{show:!1},size:g_,gap:4,font:m_,space:22,incrs:n.unit==="\xB0"?aT:void 0,values:(h,d)=>d.map(u=>String(Number(this.named(u).toPrecision(6))).replace("-","\u2212"))}],hooks:{drawClear:[h=>this.shade(h)],draw:[h=>this.point(h)],setCursor:[()=>this.showValues()]}}}named(e){let[t,n]=this.spec.turn??[-1/0,1/0];return this.branch===this.spec.turn||e>=t&&e<=n?e:e+(e<t?360:-360)}times(e,t){return this.mark===null?lT(e,t):t.map(n=>`${Number(n.toFixed(3))} s`)}point(e){if(this.mark===null)return;let{ctx:t,bbox:n}=e,s=Math.round(e.valToPos(this.mark,"x",!0))+.5;s<n.left||s>n.left+n.width||(t.save(),t.strokeStyle=jt("--muted"),t.lineWidth=devicePixelRatio,t.beginPath(),t.moveTo(s,n.top),t.lineTo(s,n.top+n.height),t.stroke(),t.restore())}shade(e){let{ctx:t,bbox:n}=e;t.save(),t.beginPath(),t.rect(n.left,n.top,n.width,n.height),t.clip();for(let{from:s,to:r,invalid:o}of this.stretches){let a=e.valToPos(s,"x",!0);t.fillStyle=jt(o?"--shade-invalid":"--shade"),t.fillRect(a,n.top,Math.max(2,e.valToPos(r,"x",!0)-a),n.height)}t.restore()}};function rT(i,e){let t=0,n=i.length;for(;t<n;){let s=t+n>>1;i[s]<=e?t=s+1:n=s}return t-1}var oT=new Intl.DateTimeFormat("en-GB",{timeStyle:"medium"}),m_="11px ui-sans-serif, system-ui, sans-serif",aT=[1,2,5,10,15,30,45,90,180];function lT(i,e){let{min:t,max:n}=i.scales.x,s=30/i.width*(n-t);return e.map(r=>r>n-s?"":oT.format(1e3*r))}function cT(i,{turn:e,lines:t}){let n=e[0]===0?[-180,180]:[0,360],s=a=>a>n[1]?a-360:a<n[0]?a+360:a,r=0,o=t.map((a,l)=>i[1+3*l]);for(let a of o){let l=null;for(let c of a)c!==null&&(l!==null&&(r+=+(Math.abs(c-l)>180)-+(Math.abs(s(c)-s(l))>180)),l=c)}return r<=0?e:(o.forEach((a,l)=>{let[c,h]=[2,3].map(d=>i[d+3*l]);a.forEach((d,u)=>{let f=d===null?0:s(d)-d;if(f)for(let p of[a,c,h])p[u]!==null&&(p[u]+=f)})}),n)}var hT=10;function uT(i,e,t,n,s){let r=i.data[0],o=i.data[e],a=[],l=null,c=0;for(let u=t;u<=n;u++){let f=o[u];if(f==null)continue;let p=Math.round(i.valToPos(r[u],"x",!0));l!=null&&Math.abs(f-l)>180&&a.push([c,p]),l=f,c=p}let h=Math.ceil(1.5*devicePixelRatio),d=hT*devicePixelRatio;return a.forEach(([u,f],p)=>{(p===0||u-a[p-1][1]>d)&&(p+1===a.length||a[p+1][0]-f>d)&&s.push([u-h,f+h])}),s.sort((u,f)=>u[0]-f[0])}function dT(i,e,t,n){if(i===null||e===null||!Number.isFinite(i)||!Number.isFinite(e))return[-t/2,t/2];if(n&&e-i>200)return n;let s=(i+e)/2,r=Math.max(t,1.12*(e-i))/2;return[s-r,s+r]}var __=g_;var fT={heading:i=>[i.heading,i.sigmaHeading],turn:i=>[i.turn,i.sigmaHeading],pitch:i=>[i.pitch,i.sigmaPitch],roll:i=>[i.roll,i.sigmaRoll],angle:i=>[i.angle,i.sigmaAngle]},pT={pitch:[-90,90],angle:[0,180]},mT=.5;function gT(i,e,t){return[Math.max(0,i.find(e)),i.find(t)+1]}function v_(i,e,t,n,s,r){let o=e.map(({ring:d})=>gT(d,t,n)),a=_T(e,o),l=new Map,c=e.map((d,u)=>vT(d.ring,o[u],a,e.length===1,s));s.forEach((d,u)=>l.set(d,[a,...c.flatMap(f=>f.slice(3*u,3*u+3))]));let h=e[0]?.ring;for(let d of r)l.set(d,h?yT(h,o[0],d):[[],[],[],[]]);return{data:l,...h?ST(i,h,o[0]):{stretches:[],lanes:[]}}}function _T(i,e){if(i.length===1)return $f(i[0].ring,e[0]);let t=new Set;return i.forEach(({ring:n},s)=>$f(n,e[s]).forEach(r=>t.add(r))),[...t].sort((n,s)=>n-s)}function $f(i,[e,t]){let n=new Array(t-e);for(let s=e;s<t;s++)n[s-e]=i.at(s);return n}function vT(i,[e,t],n,s,r){let o=Array.from({length:3*r.length},()=>new Array(n.length).fill(null)),a=0;for(let l=e;l<t;l++){let c=i.at(l);if(s)a=l-e;else for(;n[a]<c;)a++;if(l>e&&c-i.at(l-1)>mT)continue;let h=Qs(i,l);r.forEach((d,u)=>xT(o,3*u,a,...fT[d](h),pT[d]))}return o}function xT(i,e,t,n,s,[r,o]=[n-180,n+180]){Number.isFinite(n)&&(i[e][t]=n,Number.isFinite(s)&&(i[e+1][t]=Math.min(n+s,o),i[e+2][t]=Math.max(n-s,r)))}function yT(i,[e,t],n){let s=[$f(i,[e,t]),...[0,1,2].map(()=>new Array(t-e))];for(let r=e;r<t;r++)for(let o=0;o<3;o++){let a=i.value(r,n+o);s[1+o][r-e]=Number.isFinite(a)?a:null}return s}function ST(i,e,[t,n]){let s=[],r=new Map,o=NaN;for(let a=t;a<n;a++){let l=e.at(a),c=a+1<n?e.at(a+1):i.link.state==="open"&&a+1===e.length?i.edge():l;e.valid(a)?Number.isNaN(o)||(s.push({from:o,to:l,invalid:!0}),o=NaN):Number.isNaN(o)&&(o=l);for(let h=e.allFlags(a),d=0;h;h>>>=1,d++){if(!(h&1))continue;let u=r.get(d)??[];r.set(d,u);let f=u[u.length-1];f&&f[1]>=l?f[1]=c:u.push([l,c])}}return Number.isNaN(o)||s.push({from:o,to:i.edge(),invalid:!0}),{stretches:s,lanes:[...r].map(([a,l])=>({bit:a,stretches:l})).sort((a,l)=>a.bit-l.bit)}}var MT=[{label:"x",colour:"--x"},{label:"y",colour:"--y"},{label:"z",colour:"--z"}],br=(i,e={})=>({title:i,unit:"\xB0",digits:1,least:10,...e}),Zf=[-180,180],y_={title:"Rate",unit:"rad/s",digits:2,least:.5},bT={angles:{heading:br("Heading",{turn:[0,360]}),pitch:br("Pitch"),roll:br("Roll",{turn:Zf,foot:!0})},sensors:[[Ct.gyr,y_],[Ct.acc,{title:"Specific force",unit:"m/s\xB2",digits:2,least:2}],[Ct.mag,{title:"Magnetic field",unit:"\xB5T",digits:1,least:10,foot:!0}]]},x_={angles:{angle:br("Angle"),turn:br("Turn",{turn:Zf}),pitch:br("Pitch"),roll:br("Roll",{turn:Zf,foot:!0})},sensors:[[Ct.rate,{...y_,foot:!0}]]},wT=1/400,jh=class{constructor(e,t,n){this.store=e;this.playhead=t;this.device=n;let{angles:s,sensors:r}=n.shape==="joint"?x_:bT;this.kinds={angles:s,sensors:n.sensors===!1?x_.sensors:r},this.observer.observe(this.element),this.scheme.addEventListener("change",this.recolour),this.lanes.style.setProperty("--axis",`${__}px`)}store;playhead;device;element=F("div",{class:"plots"});charts=new Map;kinds;lanes=F("div",{class:"lanes"});rows=new Map;shown="";drawn=0;version=-1;observer=new ResizeObserver(()=>this.each(e=>e.fit()));scheme=matchMedia("(prefers-color-scheme: dark)");recolour=()=>this.each(e=>e.recolour());destroy(){this.observer.disconnect(),this.scheme.removeEventListener("change",this.recolour),this.each(e=>e.destroy())}ends(e){return this.charts.get(e)?.ends??null}each(e){for(let t of this.charts.values())e(t)}update(e){let t=this.playhead.range(),n=Math.min(500,Math.max(66,(t[1]-t[0])*1e3/600));if(e-this.drawn<n||this.version===this.store.version&&!this.playhead.following)return;this.drawn=e,this.version=this.store.version;let s=this.store.tracksOf(this.device.id).filter(h=>h.ring.length);this.build(s.map(({method:h,colour:d,running:u})=>({label:h.name+(u?"":" (before)"),colour:`--m${d}`,dashed:!u})));let r=this.store.instant&&this.playhead.time,o=Object.keys(this.kinds.angles),{stretches:a,lanes:l,data:c}=v_(this.store,s,...t,o,this.kinds.sensors.map(([h])=>h));for(let[h,d]of this.charts)d.set(c.get(h),t,a,r);this.drawLanes(l,t)}build(e){let t=JSON.stringify(e);if(t===this.shown)return;this.shown=t,this.each(o=>o.destroy());let n=bn.sync(`device ${this.device.id}`),s=Object.entries(this.kinds.angles).map(([o,a])=>[o,new nl({...a,lines:e,bands:!0},n)]),r=this.kinds.sensors.map(([o,a])=>[o,new nl({...a,lines:MT,bands:!1},n)]);this.charts=new Map([...s,...r]),this.element.replaceChildren(...s.map(([,o])=>o.element),this.lanes,...r.map(([,o])=>o.element)),this.each(o=>o.fit())}drawLanes(e,[t,n]){let s=new Set(e.map(o=>o.bit));for(let[o,{row:a}]of this.rows)s.has(o)||(a.remove(),this.rows.delete(o));for(let{bit:o,stretches:a}of e){let[l]=this.store.sentences(1<<o>>>0);if(!l)continue;let c=this.rows.get(o);if(!c){let d=F("div",{class:"bars"}),u=F("div",{class:l.invalid?"lane invalid":"lane"},F("p",{},F("b",{},l.name.toLowerCase().replaceAll("_"," ")),F("span",{},l.sentence)),d);c={row:u,bar:d,key:""},this.rows.set(o,c),this.lanes.append(u)}let h=ET(a,t,wT*(n-t));for(;c.bar.childElementCount>h.length;)c.bar.lastElementChild.remove();for(;c.bar.childElementCount<h.length;)c.bar.append(F("i"));h.forEach(([d,u],f)=>{let p=Math.max(0,(d-t)/(n-t)),x=Math.min(1,(u-t)/(n-t)),{style:m}=c.bar.children[f];m.left=`${(100*p).toFixed(2)}%`,m.width=`${Math.max(.2,100*(x-p)).toFixed(2)}%`})}let r=this.lanes.querySelector(".none");!this.rows.size&&!r&&this.lanes.append(F("p",{class:"none"},"")),r=this.lanes.querySelector(".none"),r&&(this.rows.size?r.remove():et(r,"No flags in this window"))}};function ET(i,e,t){let n=[];for(let[s,r]of i){if(r<e)continue;let o=n.at(-1);o&&s-o[1]<t?o[1]=Math.max(o[1],r):n.push([s,r])}return n}var eu=class{value=F("span",{class:"figure"},"\u2013");sigma=F("span",{class:"sigma"});note=F("p",{class:"note"});element;constructor(e){this.element=F("div",{class:"readout"},F("h2",{},e),F("p",{},this.value,F("span",{class:"degree"},"\xB0"),this.sigma),this.note)}set(e,t,n){et(this.value,en(e,1)),et(this.sigma,Number.isFinite(t)?`\xB1 ${en(t,1)}\xB0`:""),et(this.note,n)}},tu=class{constructor(e,t,n){this.store=e;this.playhead=t;this.device=n;let s=n.shape==="joint";[this.first,this.second]=[new eu(s?"Angle":"Heading"),new eu("Tilt")],this.about=s?["Turn","Pitch","Roll"].map(()=>F("dd")):null;let r=this.about?F("dl",{class:"facts"},...["Turn","Pitch","Roll"].map((o,a)=>F("div",{},F("dt",{},o),this.about[a]))):this.second.element;this.element=F("div",{class:"readouts"},F("div",{class:"pair"},this.first.element,r),F("div",{class:"state"},this.verdict,this.tip,this.why,this.remedy),this.others,this.spoken)}store;playhead;device;element;first;second;about;verdict=F("p",{class:"verdict"});why=F("p",{class:"why"});remedy=F("p",{class:"remedy"});tip=F("p",{class:"tip"});others=F("div",{class:"others"});spoken=F("p",{class:"unseen",role:"status","aria-live":"polite"});written=0;row(e){return this.playhead.following?e.ring.length-1:e.ring.find(this.playhead.time)}update(e){if(e-this.written<100)return null;this.written=e;let t=this.store.tracksOf(this.device.id).filter(c=>c.running),[n]=t,s=n?this.row(n):-1,r=n?this.playhead.following?this.store.whyInvalid(n,s):this.whyThen(n,s):"its method is being loaded",o=n&&s>=0?Qs(n.ring,s):null;this.figures(o,n),et(this.verdict,r?"Not valid":"Valid"),et(this.why,r),et(this.remedy,r&&this.playhead.following?this.toDo():""),et(this.spoken,`${this.device.id}: attitude ${r?`not valid: ${r}`:"valid"}`);let a=n&&s>=0?n.ring.tip(s):255,l=a!==255;return et(this.tip,l?mr(a):""),this.tip.classList.toggle("bad",Rs.has(a)),this.element.classList.toggle("invalid",r!==""),this.compare(t.slice(1)),{invalid:r,tip:l?a:null}}toDo(){let e=this.store.conditions.get(this.device.id);return e&&this.store.link.state==="open"?kg(e,this.about!==null):""}figures(e,t){if(this.about){let{segment:n,base:s}=this.device;this.first.set(e?.angle??NaN,e?.sigmaAngle??NaN,n&&s?`of ${n}, seen from ${s}`:"seen from another body");let r=e?[e.turn,e.pitch,e.roll]:[NaN,NaN,NaN];this.about.forEach((o,a)=>et(o,`${en(r[a],1)}\xB0`));return}this.first.set(e?.heading??NaN,e?.sigmaHeading??NaN,t?$a[t.method.heading]:""),this.second.set(e?.tilt??NaN,e?.sigmaTilt??NaN,"between its z axis and up")}whyThen(e,t){return t<0?"nothing is held of this instant":e.ring.valid(t)?"":this.store.sentences(e.ring.flags(t)).filter(n=>n.invalid).map(n=>n.sentence).join("; ")||"not to be acted on"}compare(e){for(;this.others.childElementCount>e.length;)this.others.lastElementChild.remove();for(;this.others.childElementCount<e.length;)this.others.append(F("p",{},F("i",{class:"key"}),F("span"),F("b")));e.forEach((t,n)=>{let[s,r,o]=this.others.children[n].children,a=this.row(t),l=a>=0?Qs(t.ring,a):null;s.style.setProperty("--key",`var(--m${t.colour})`),et(r,t.method.name);let[c,h]=l?this.about?[l.angle,l.turn]:[l.heading,l.tilt]:[NaN,NaN];et(o,l?`${en(c,1)}\xB0  \xB7  ${en(h,1)}\xB0${t.ring.valid(a)?"":"  not valid"}`:"\u2013")})}};var No=class{constructor(e,t,n,s,r){this.store=e;this.stage=n;this.source=s;this.device=r;let o=r.shape==="joint";this.readout=new tu(e,t,r),this.plots=new jh(e,t,r),this.methods=o?null:new Oh(e,s,r.id),this.link=new Fh(e,r),this.events=new Mo(e,r.id),this.body.setAttribute("aria-label",`${r.id}: ${o?"how it stands seen from its base":"its body over the ground, north marked"}. Arrow keys turn the view.`),this.view=new Rh(e,t,r.id,this.body,r.shape),this.forward=F("button",{onclick:()=>{this.reset()}},o?"Both point the same way":"This way is forward"),this.forward.title=o?`Sets the headings of ${r.segment} and ${r.base} to 0\xB0 where their y axes point now`:"Sets the heading to 0\xB0 where its y axis points now",this.card=F("section",{class:"card","aria-label":"Attitude"},this.body,this.readout.element,s.live&&F("div",{class:"actions"},this.forward,this.answer)),this.element=F("div",{class:"detail"},F("div",{class:"left"},this.card),this.plots.element,s instanceof qs?F("aside",{class:"side","aria-label":"Methods and flags"},new Uh(e,t,r.id,s.films.get(r.id)).element):F("aside",{class:"side","aria-label":"Methods, link and events"},this.methods?.element??TT(r),this.link.element,this.events.element)),n.add(this.view),n.works||this.body.append(F("p",{class:"note"},"This browser draws no WebGL: numbers and plots only.")),this.sync()}store;stage;source;device;element;body=F("div",{class:"body",tabindex:0,role:"img"});readout;plots;methods;link;events;view;answer=F("p",{class:"answer",role:"status","aria-live":"polite"});forward;card;destroy(){this.stage.remove(this.view),this.plots.destroy()}drawn(e=0){return this.view.scene.drawn(e)}ends(e){return this.plots.ends(e)}sync(){this.methods?.sync();let e=this.store.hello?.may_write!==!1;this.forward.disabled=!e||!this.source.live,e||(this.forward.title="This needs a token with the scope \u201Cwrite\u201D")}update(e){let t=this.readout.update(e);t&&(this.card.classList.toggle("invalid",t.invalid!==""),this.card.classList.toggle("alarming",t.tip!==null&&Rs.has(t.tip)&&this.store.link.state==="open")),this.plots.update(e),this.link.update(e),this.events.update(e)}async reset(){this.answer.classList.remove("bad");try{let{id:e,segment:t,base:n}=this.device;for(let s of t&&n?[t,n]:[e])await this.source.ask({type:"reset_heading",device:s,forward:"y"});et(this.answer,t&&n?"Both headings set to 0\xB0":"Heading set to 0\xB0")}catch(e){et(this.answer,e.message),this.answer.classList.add("bad")}setTimeout(()=>et(this.answer,""),4e3)}};function TT({segment:i,base:e}){let t=(n,s="")=>F("div",{},F("dt",{},n),F("dd",{},F("a",{href:gr(s)},s)));return F("section",{class:"panel","aria-label":"Joint"},F("h2",{},"Joint"),F("dl",{class:"facts"},t("Segment",i),t("Seen from",e)),F("p",{class:"note"},"A difference between the headings of the two is in it. Hold both so that their y axes point the same way, then press the button."))}var il=(i,e="")=>["x","y","z"].map(t=>`${i}_${t}${e&&` (${e})`}`),AT=["device","method","time (s)","host_time","sequence","qw","qx","qy","qz",...il("rate"),...il("sigma"),...il("gyr","rad/s"),...il("acc","m/s\xB2"),...il("mag","\xB5T"),"valid","tip","flags","flag_names"].join(),RT=19;function S_(i,e){let t=[AT];for(let n of e)for(let{method:s,ring:r}of i.tracksOf(n))for(let o=0;o<r.length;o++){let a=[n,s.name,r.deviceTime(o),r.hostTime(o).toFixed(6),r.sequence(o)];for(let c=0;c<RT;c++)a.push(CT(r.value(o,Ct.quat+c)));let l=r.tip(o);a.push(Number(r.valid(o)),l===255?"":l,r.flags(o),i.sentences(r.flags(o)).map(c=>c.name).join("|")),t.push(a.join(","))}return t.join(`
`)+`
`}function CT(i){return Number.isFinite(i)?String(Number(i.toPrecision(9))):""}function M_(i,e){Jf(i,new Blob([e],{type:"text/csv"}))}function Jf(i,e){let t=URL.createObjectURL(e),n=document.createElement("a");n.href=t,n.download=i,n.click(),setTimeout(()=>URL.revokeObjectURL(t),6e4)}function Kf(i,...e){let t=`title-${i.toLowerCase().replaceAll(/\W+/g,"-")}`,n=F("dialog",{"aria-labelledby":t},F("h2",{id:t},i),...e);return n.addEventListener("click",s=>{s.target===n&&n.close()}),document.body.append(n),n}function E_(i){return F("div",{class:"buttons"},F("button",{onclick:()=>i().close()},"Close"))}var nu=class{reason=F("p",{class:"answer bad",role:"alert"});input=F("input",{type:"password",id:"token",autocomplete:"off",spellcheck:"false",required:!0});element;constructor(e){let t=F("form",{},F("label",{for:"token"},"Token"),this.input,this.reason,F("div",{class:"buttons"},F("button",{type:"submit",class:"main"},"Connect")));this.element=Kf("This server wants a token",F("p",{},"It is the one that \u201Cpoise live\u201D was started with. It is kept until this tab is closed, and is in no address."),t),t.addEventListener("submit",n=>{n.preventDefault(),this.element.close(),e.identify(this.input.value.trim()),this.input.value=""})}close(){this.element.close()}ask(e){et(this.reason,e),this.element.open||this.element.showModal(),this.input.focus()}},iu=class{constructor(e){this.source=e;this.element=Kf("Use a phone",this.what,this.image,F("p",{},F("a",{href:"/phone"},"Open that page here")),E_(()=>this.element))}source;what=F("p");image=F("div",{class:"qr"});element;async open(){this.image.replaceChildren(),et(this.what,""),this.element.showModal();let e=await this.source.get("/phone/qr.svg").catch(()=>null);if(!e?.ok)return et(this.what,e?e.status===401?"The code holds a token, which is shown to whoever has one with the scope \u201Cwrite\u201D.":await T_(e):"The server cannot be reached.");et(this.what,"Point the phone\u2019s camera at this. The page that it opens sends the phone\u2019s motion here.");let t=F("img",{alt:"QR code of the page for phones",src:URL.createObjectURL(new Blob([await e.text()],{type:"image/svg+xml"}))});this.image.replaceChildren(t)}},su=class{constructor(e,t){this.store=e;this.source=t;this.element=Kf("Download",this.held,this.recordings,this.answer,E_(()=>this.element))}store;source;held=F("div",{class:"held"});recordings=F("div",{class:"held"});answer=F("p",{class:"answer",role:"status","aria-live":"polite"});element;async open(e){let t=e?[e]:[...this.store.devices.keys()],n=F("button",{id:"save-csv",class:"main",onclick:()=>M_(`poise-${e??"devices"}-${new Date().toISOString().slice(0,19).replaceAll(":","-")}.csv`,S_(this.store,t))},"Save as CSV");if(this.held.replaceChildren(F("h3",{},"What this page holds"),F("p",{},`The last minutes of ${e??`${Di(t.length)} devices`}, 30 rows a second: attitude, sigma, sensors, flags.`),n),this.recordings.replaceChildren(),et(this.answer,""),this.element.showModal(),!(!this.store.hello?.recording||!this.store.hello.offers.includes("/recordings")))try{let s=await(await this.fetched("/recordings")).json();s.sort((o,a)=>b_(a).localeCompare(b_(o),"en"));let r=s.length?s.map(o=>this.file(o)):[F("p",{class:"none"},"Nothing yet.")];this.recordings.replaceChildren(F("h3",{},"Recorded by the server, every sample"),F("div",{class:"files"},...r))}catch(s){this.tell(`What was recorded cannot be listed: ${s.message}`,!0)}}file({name:e,bytes:t,url:n}){let s=async()=>{r.disabled=!0,this.tell(`Fetching ${e} \u2026`);try{let o=await(await this.fetched(n)).blob();Jf(e.split("/").pop(),o),this.tell(`${e}: ${w_(o.size)}`)}catch(o){this.tell(o.message,!0)}r.disabled=!1},r=F("button",{class:"quiet",onclick:()=>{s()}},e);return F("p",{class:"file"},r,F("span",{},t===null?"being recorded":w_(t)))}async fetched(e){let t=await this.source.get(e).catch(()=>{throw new Error("the server cannot be reached")});if(t.ok)return t;throw new Error(await T_(t))}tell(e,t=!1){et(this.answer,e),this.answer.classList.toggle("bad",t)}};function b_({name:i}){return i.split("/")[0]}function w_(i){return i>=1e6?`${(i/1e6).toFixed(1)} MB`:`${Math.ceil(i/1e3)} kB`}async function T_(i){let e=await i.text().catch(()=>"");try{return JSON.parse(e).error}catch{return e.trim()||`the server answers ${i.status}`}}var A_=1e3,PT=6e3,Qf=class{constructor(e,t,n){this.store=e;this.source=t;this.id=n;this.button=F("button",{"aria-label":`Acknowledge the alarm of ${n}`,onclick:()=>{this.acknowledge()}},"Acknowledge"),this.name=F("strong",{},n),this.element=F("div",{},this.name,this.text,this.answer,this.button)}store;source;id;element;name;text=F("p",{tabindex:-1});answer=F("span",{class:"answer bad",role:"status"});button;pressed=-A_;asking=!1;before=null;over=null;update(e){if(this.before&&this.before===this.store.health)return!0;this.before=null,!this.name.firstElementChild&&this.store.devices.has(this.id)&&this.name.replaceChildren(F("a",{href:gr(this.id)},this.id));let t=e?.unacknowledged??[];return t.length?this.ask(t):this.tell(e?.holding??[]),this.over===null||performance.now()-this.over<PT}ask(e){let t=this.store.hello?.may_write!==!1;this.over=null,et(this.text,`Alarm not acknowledged: ${af(e)} ${e.length===1?"holds":"hold"} until it has been and ${this.id} stands upright.${t?"":" This needs a token with the scope \u201Cwrite\u201D."}`),this.button.hidden=!1,this.button.disabled=!t,this.button.setAttribute("aria-disabled",String(this.busy))}tell(e){et(this.text,e.length?`Acknowledged. Until ${this.id} stands upright, there holds: ${af(e)}.`:"Acknowledged: nothing holds any more."),et(this.answer,""),!this.button.hidden&&document.activeElement===this.button&&this.text.focus(),this.button.hidden=!0,this.over=e.length?null:this.over??performance.now()}get busy(){return this.asking||performance.now()-this.pressed<A_}async acknowledge(){if(!this.busy){this.pressed=performance.now(),this.asking=!0,this.button.setAttribute("aria-disabled","true"),et(this.answer,"");try{let{holding:e}=await this.source.ask({type:"acknowledge",device:this.id});this.before=this.store.health,this.tell(e??[])}catch(e){let t=this.store.link.state==="open"?"Not acknowledged":"No answer";et(this.answer,`${t}: ${e.message}`)}this.asking=!1}}},ru=class{constructor(e,t){this.store=e;this.source=t;e.on(["hello"],()=>this.clear())}store;source;element=Rn("latched");rows=new Map;update(){let{health:e}=this.store;if(!e)return;let t=new Map(e.alarms.map(n=>[n.device,n]));for(let n of e.alarms)n.unacknowledged.length&&!this.rows.has(n.device)&&this.add(n.device);for(let[n,s]of this.rows)s.update(t.get(n))||this.remove(n,s);document.body.classList.toggle("latching",this.rows.size>0)}add(e){let t=new Qf(this.store,this.source,e);this.rows.set(e,t),this.element.append(t.element)}remove(e,t){t.element.remove(),this.rows.delete(e)}clear(){for(let[e,t]of this.rows)this.remove(e,t)}};var Uo=class{constructor(e){this.store=e}store;stopped=null;window=30;told=[];get following(){return this.stopped===null}get time(){return this.stopped??this.store.edge()}onChange(e){this.told.push(e)}pause(){this.seek(this.store.lastSeen())}follow(){this.stopped=null,this.changed()}toggle(){this.following?this.pause():this.follow()}seek(e){this.stopped=Math.min(this.store.edge(),e),this.changed()}setWindow(e){this.window=e,this.changed()}range(){return[this.time-this.window,this.time]}changed(){this.store.version++;for(let e of this.told)e()}};var IT=[.1,.5,1,2,5,20],LT=[[5,"5 s"],[30,"30 s"],[120,"2 min"],[1/0,"All"]],R_=1,wr=class extends Uo{constructor(t,n){super(t);this.held=t;this.source=n;this.window=1/0,t.instant=()=>this.instant}held;source;instant=0;playing=!1;speed=1;last=0;get following(){return!1}get time(){return this.instant}get end(){return this.source.duration}range(){if(this.window>=this.end)return[0,this.end];let t=Math.min(this.end-this.window,Math.max(0,this.instant-this.window/2));return[t,t+this.window]}seek(t){this.instant=Math.min(this.end,Math.max(0,t)),this.changed()}toggle(){!this.playing&&this.instant>=this.end&&(this.instant=0),this.playing=!this.playing,this.changed()}pause(){this.playing&&this.toggle()}setSpeed(t){this.speed=t,this.changed()}advance(t){let n=Math.min(.5,(t-this.last)/1e3);this.last=t,this.playing&&(this.instant=Math.min(this.end,this.instant+n*this.speed),this.held.version++,this.instant>=this.end&&this.toggle())}},ou=class{constructor(e){this.reel=e;let t=LT.map(([s,r])=>{let o=F("input",{type:"radio",name:"window",id:`window-${s}`,value:s,checked:s===e.window,onchange:()=>e.setWindow(s)});return F("label",{for:o.id},o,F("span",{},r))}),n=F("select",{id:"speed","aria-label":"Speed",onchange:()=>e.setSpeed(Number(n.value))},...IT.map(s=>F("option",{value:s,selected:s===1},`${s}\xD7`)));Rn("transport").append(this.play,this.slider,this.label,n,F("fieldset",{class:"windows"},F("legend",{class:"unseen"},"Plots show"),...t)),this.slider.addEventListener("input",()=>e.seek(Number(this.slider.value))),e.onChange(()=>this.update()),addEventListener("keydown",s=>{if(!s.target.closest("button, input, select, textarea, summary, a, dialog, .body")){if(s.key===" ")e.toggle();else if(s.key==="ArrowLeft"||s.key==="ArrowRight")e.seek(e.time+(s.key==="ArrowLeft"?-R_:R_));else return;s.preventDefault()}})}reel;play=F("button",{class:"play",id:"play",onclick:()=>this.reel.toggle()},"Play");slider=F("input",{type:"range",id:"scrub","aria-label":"Instant shown, seconds from the start",min:0,max:1,step:.01,value:0});label=F("output",{for:"scrub",id:"instant"});update(){let{reel:e}=this;this.slider.max=String(e.end),this.slider.value=String(e.time);let t=`${e.time.toFixed(2)} s of ${e.end.toFixed(1)} s`;et(this.label,t),this.slider.setAttribute("aria-valuetext",t),et(this.play,e.playing?"Pause":"Play"),this.play.setAttribute("aria-pressed",String(e.playing))}};function DT(){let i=document.createElement("canvas").getContext("webgl2"),e=i?.getParameter(i.getExtension("WEBGL_debug_renderer_info")?.UNMASKED_RENDERER_WEBGL??i.RENDERER);return/swiftshader|llvmpipe|softpipe|basic render/i.test(e??"")}var NT=12,au=class{redraws=0;renderer=null;canvas=Rn("stage");views=new Set;size="";place="";dirty=!0;constructor(){try{this.renderer=new xh({canvas:this.canvas,alpha:!0,antialias:!DT(),powerPreference:"low-power"}),this.renderer.setScissorTest(!0),this.renderer.setClearColor(0,0),Wt.refresh()}catch{this.canvas.hidden=!0}let e=()=>this.dirty=!0;addEventListener("resize",e),addEventListener("scroll",e,{passive:!0,capture:!0});let t=new ResizeObserver(e);for(let n of["bar","alarm","banner","main","transport"])t.observe(Rn(n));matchMedia("(prefers-color-scheme: dark)").addEventListener("change",()=>{Wt.refresh(),this.dirty=!0})}get works(){return this.renderer!==null}add(e){this.views.add(e),this.dirty=!0}remove(e){this.views.delete(e),this.dirty=!0}draw(){let{renderer:e}=this;for(let r of this.views)r.update();if(this.dirty=!1,this.redraws++,!e)return;let t=Rn("bar").getBoundingClientRect().bottom,n=Rn("transport").getBoundingClientRect().top,s=new Map;for(let r of this.views)for(let o of r.elements){let a=o.getBoundingClientRect();a.width>0&&a.bottom>t&&a.top<n&&s.set(o,a)}if(this.canvas.hidden=s.size===0,!!s.size){this.fit(e,[...s.values()],t,n);for(let r of this.views)r.draw(e,s,this.area)}}area={left:0,top:0,width:0,height:0};fit(e,t,n,s){let r=Math.floor(Math.min(...t.map(u=>u.left))),o=Math.floor(Math.max(n,Math.min(...t.map(u=>u.top)))),a=Math.ceil(Math.max(...t.map(u=>u.right)))-r,l=Math.ceil(Math.min(s,Math.max(...t.map(u=>u.bottom))))-o;this.area={left:r,top:o,width:a,height:l};let c=Math.min(devicePixelRatio,t.length>NT?1:2),h=`${a} ${l} ${c}`;h!==this.size&&(this.size=h,e.setPixelRatio(c),e.setSize(a,l));let d=`translate(${r}px, ${o}px)`;d!==this.place&&(this.canvas.style.transform=this.place=d),e.setScissor(0,0,a,l),e.clear()}};var UT=256,lu=120/4,C_=120/8,FT=48,cu=class{bytes=new Uint8Array(0);floats=new Float32Array(0);words=new Uint32Array(0);doubles=new Float64Array(0);stamps=new Float64Array(0);capacity=0;first=0;length=0;push(e,t,n,s){if(this.length&&this.same(this.slot(this.length-1),e,t))return;this.length===this.capacity&&this.capacity<s&&this.grow(Math.min(s,Math.max(UT,2*this.capacity))),this.length===this.capacity&&(this.first=(this.first+1)%this.capacity,this.length--);let r=(this.first+this.length)%this.capacity;this.bytes.set(e.subarray(t,t+120),r*120),this.stamps[r]=this.length?Math.max(n,this.stamps[this.slot(this.length-1)]):n,this.length++}same(e,t,n){for(let s=0;s<FT;s++)if(this.bytes[e*120+s]!==t[n+s])return!1;return!0}clear(){this.first=this.length=0}grow(e){let t=new Uint8Array(e*120),n=new Float64Array(e);for(let s=0;s<this.length;s++){let r=this.slot(s);t.set(this.bytes.subarray(r*120,(r+1)*120),s*120),n[s]=this.stamps[r]}this.bytes=t,this.stamps=n,this.floats=new Float32Array(t.buffer),this.words=new Uint32Array(t.buffer),this.doubles=new Float64Array(t.buffer),this.capacity=e,this.first=0}slot(e){return(this.first+e)%this.capacity}at(e){return this.stamps[this.slot(e)]}value(e,t){return this.floats[this.slot(e)*lu+t]}deviceTime(e){return this.doubles[this.slot(e)*C_+Ct.time]}hostTime(e){return this.doubles[this.slot(e)*C_+Ct.host]}sequence(e){let t=this.slot(e)*lu+2*Ct.sequence;return this.words[t]+2**32*this.words[t+1]}flags(e){return this.words[this.slot(e)*lu+Ct.flags]}allFlags(e){let t=this.slot(e)*lu;return(this.words[t+Ct.flags]|this.words[t+Ct.flagsSince])>>>0}valid(e){return this.bytes[this.slot(e)*120+Ct.valid]===1}tip(e){return this.bytes[this.slot(e)*120+Ct.tip]}find(e){let t=0,n=this.length;for(;t<n;){let s=t+n>>1;this.at(s)<=e?t=s+1:n=s}return t-1}};var jf=300,OT=9e3,BT=192<<20,kT=500,zT=5,hu=class{instant=null;hello=null;health=null;devices=new Map;conditions=new Map;events=[];link={state:"connecting"};dropped=0;version=0;delays=new Map;tracks=new Map;byNumber=new Map;listeners=new Map;clock=1/0;newest=0;on(e,t){for(let n of e)this.listeners.set(n,[...this.listeners.get(n)??[],t])}tell(e){for(let t of this.listeners.get(e)??[])t()}connection(e){this.link=e,this.version++,this.tell("connection")}message(e){switch(e.type){case"hello":return this.hello=e,this.health=null,this.clock=1/0,this.compareClocks(e.time),this.recall(e.events??[]),this.tell("hello");case"devices":return this.setDevices(e.devices),this.tell("devices");case"health":this.health=e,this.compareClocks(e.time);for(let t of e.devices)this.conditions.set(t.id,t);return this.tell("health");case"event":return this.events.push(e),this.events.length>kT&&this.forgetOne(),this.tell("event");case"dropped":this.dropped=e.frames}}frame(e){let t=!0,n=new DataView(e);if(n.getUint8(0)!==1||n.getUint8(1)!==2||n.getUint16(2,!0)!==120)return t;let s=new Uint8Array(e),r=this.serverNow(),o=Math.max(64,Math.min(OT,Math.floor(BT/120/Math.max(1,this.trackCount))));for(let a=16;a+120<=e.byteLength;a+=120){let l=this.byNumber.get(n.getUint32(a,!0)),c=l?.tracks[n.getUint8(a+Ct.method)];if(!l||!c){t=!1;continue}let h=n.getFloat64(a+8*Ct.host,!0),d=this.instant||Math.abs(h-r)<zT?h:r;c.ring.push(s,a,d,o),d>this.newest&&(this.newest=d);let u=this.delays.get(l.id);this.delays.set(l.id,u===void 0?r-d:u+.05*(r-d-u))}return this.version++,t}cleared(e){for(let{ring:t}of this.tracks.get(e)?.values()??[])t.clear()}setDevices(e){this.devices.clear(),this.byNumber.clear();for(let t of e){this.devices.set(t.id,t);let n=this.tracks.get(t.id)??new Map;this.tracks.set(t.id,n);for(let r of n.values())r.running=!1;let s=[];for(let r of t.methods){let o=`${r.name} ${r.settings}`,a=n.get(o);a||n.set(o,a={device:t.id,method:r,colour:HT(n),ring:new cu,running:!0}),a.method=r,a.running=!0,s[r.number]=a}this.forget(n),this.byNumber.set(t.number,{id:t.id,tracks:s})}for(let t of this.tracks.keys())this.devices.has(t)||this.tracks.delete(t);this.version++}forget(e){let t=[...e].filter(([,n])=>!n.running);for(let[n]of t.slice(0,Math.max(0,t.length-2)))e.delete(n)}get trackCount(){let e=0;for(let t of this.tracks.values())e+=t.size;return e}recall(e){let t=({time:r,text:o})=>`${r} ${o}`,n=new Set(e.map(t)),s=this.events.filter(r=>!n.has(t(r)));this.events.splice(0,this.events.length,...[...s,...e].sort((r,o)=>r.time-o.time))}forgetOne(){let e=({device:s,kind:r})=>`${r==="tip"} ${s}`,t=new Map;for(let s of this.events)t.set(e(s),(t.get(e(s))??0)+1);let n=Math.max(...t.values());this.events.splice(this.events.findIndex(s=>t.get(e(s))===n),1)}compareClocks(e){this.clock=Math.min(this.clock,Date.now()/1e3-e)}serverNow(){return Date.now()/1e3-(Number.isFinite(this.clock)?this.clock:0)}edge(){return this.instant?this.newest:this.link.state==="open"?this.serverNow():this.newest||this.serverNow()}lastSeen(){let e=this.edge();return e-this.newest<.5?this.newest:e}oldest(e){let t=1/0;for(let[n,s]of this.tracks)if(!(e!==void 0&&n!==e))for(let{ring:r}of s.values())r.length&&(t=Math.min(t,r.at(0)));return t}tracksOf(e){return[...this.tracks.get(e)?.values()??[]].sort((t,n)=>Number(n.running)-Number(t.running)||t.method.number-n.method.number)}mainTrack(e){return this.tracksOf(e)[0]}sentences(e){let t=[];for(let n=0;n<32;n++){let s=e>>>n&1?this.hello?.flags[n]:void 0;s&&t.push({bit:n,name:s[0],sentence:s[1],invalid:(this.hello.invalid_flags>>>n&1)===1})}return t}whyInvalid(e,t){if(this.link.state!=="open")return"connection lost: the attitude now is unknown";let n=this.conditions.get(e.device)?.state,s=n&&Bg[n];return t<0?s??"no sample yet":e.ring.valid(t)?"":this.sentences(e.ring.flags(t)).filter(o=>o.invalid).map(o=>o.name==="SILENT"&&s?s:o.sentence).join("; ")||"the method says that it may not be acted on"}tipOf(e){let t=this.mainTrack(e)?.ring;if(!t?.length)return null;let n=t.tip(this.instant?Math.max(0,t.find(this.instant())):t.length-1);return n<ll.length?n:null}};function HT(i){let e=new Set([...i.values()].map(n=>n.colour)),t=0;for(;e.has(t);)t++;return t%6}var GT=[[10,"10 s"],[30,"30 s"],[120,"2 min"],[jf,"5 min"]],ep=.05,uu=class{constructor(e,t){this.store=e;this.playhead=t;let n=GT.map(([s,r])=>{let o=F("input",{type:"radio",name:"window",id:`window-${s}`,value:s,checked:s===t.window,onchange:()=>t.setWindow(s)});return F("label",{for:o.id},o,F("span",{},r))});Rn("transport").append(this.pause,this.slider,this.label,F("fieldset",{class:"windows"},F("legend",{class:"unseen"},"Plots reach back"),...n)),this.slider.addEventListener("input",()=>{let s=Number(this.slider.value);s>=0?t.follow():t.seek(e.edge()+s)}),this.slider.addEventListener("pointerdown",()=>this.dragged=!0);for(let s of["pointerup","pointercancel"])addEventListener(s,()=>this.dragged=!1);t.onChange(()=>this.write()),addEventListener("keydown",s=>{let r=s.target;s.key!==" "||r.closest("button, input, select, textarea, summary, a, dialog")||(s.preventDefault(),t.toggle())})}store;playhead;pause=F("button",{class:"play",id:"pause",onclick:()=>this.playhead.toggle()},"Pause");slider=F("input",{type:"range",id:"scrub","aria-label":"Instant shown, seconds before now",max:0,step:ep,value:0});label=F("output",{for:"scrub",id:"instant"});written=0;dragged=!1;update(e){e-this.written<200||(this.written=e,this.write())}write(){let e=this.store.edge(),t=this.playhead.following?0:Math.min(0,this.playhead.time-e),n=this.store.oldest(),s=Math.max(1,Math.min(jf+60,Number.isFinite(n)?e-n:1));this.slider.min=(-Math.ceil(s/ep)*ep).toFixed(2),this.dragged||(this.slider.value=String(t));let r=this.playhead.following?"now":`${t.toFixed(1).replace("-","\u2212")} s`;et(this.label,r),this.slider.setAttribute("aria-valuetext",this.playhead.following?"now":`${(-t).toFixed(1)} seconds ago`),et(this.pause,this.playhead.following?"Pause":"Back to now"),this.pause.setAttribute("aria-pressed",String(!this.playhead.following)),document.body.classList.toggle("paused",!this.playhead.following)}};var VT=20,tp=class{constructor(e){this.source=e;this.playhead=e instanceof qs?new wr(this.store,e):new Uo(this.store),this.latched=new ru(this.store,e);let t=new nu(e);this.bar=new Lh(this.store,new iu(e),new su(this.store,e),()=>this.chosen),this.transport=this.playhead instanceof wr?new ou(this.playhead):new uu(this.store,this.playhead),this.store.on(["hello","devices"],()=>this.show()),this.store.on(["connection"],()=>{this.store.link.state==="refused"?t.ask(this.store.link.reason):this.store.link.state==="open"&&t.close(),this.slow()}),addEventListener("hashchange",()=>{let n=df();n&&e.identify(n),this.show()}),addEventListener("keydown",n=>{n.key==="Escape"&&this.chosen&&this.store.devices.size>1&&!document.querySelector("dialog[open]")&&(location.hash="#/")}),setInterval(()=>this.slow(),250),this.show(),this.source.start(this.store),requestAnimationFrame(n=>this.frame(n)),this.expose()}source;store=new hu;playhead;stage=new au;crowd=new Dh;shown=null;all=null;key="";version=-1;last=0;transport;bar;alarm=new Ph(this.store);latched;banner=new Ih(this.store);get chosen(){let e=XT(location.hash);return this.store.devices.has(e)?e:this.store.devices.size===1?[...this.store.devices.keys()][0]:null}show(){let{devices:e,hello:t}=this.store,{chosen:n}=this;if(t?.films&&this.source.live)return location.replace(`?view${location.hash}`);let s=n===null?void 0:e.get(n),r=t?e.size?s?`device ${n} ${s.shape} ${s.segment}/${s.base}`:"all":"empty":"nothing";if(r!==this.key){this.key=r,this.shown?.destroy(),this.shown=this.all=null;let o=Rn("main");o.className=r.split(" ")[0],r==="nothing"?o.replaceChildren():r==="empty"?o.replaceChildren(WT()):s?this.shown=new No(this.store,this.playhead,this.stage,this.source,s):this.shown=new So(this.store,this.playhead,this.stage,this.crowd),this.shown&&o.replaceChildren(this.shown.element),this.shown instanceof So&&this.source.live&&o.append((this.all=new Mo(this.store,null)).element),scrollTo(0,0)}this.shown?.sync(),this.slow()}slow(){if(this.bar.update(),this.alarm.update(),this.latched.update(),this.banner.update(),this.source instanceof qs&&this.playhead instanceof wr)for(let e of this.chosen?[this.chosen]:this.store.devices.keys())this.source.look(e,this.playhead.range(),this.playhead.speed)}frame(e){requestAnimationFrame(t=>this.frame(t)),!(e-this.last<VT)&&(this.last=e,this.playhead instanceof wr&&this.playhead.advance(e),this.shown?.update(e),this.all?.update(e),this.transport.update(e),!(this.version===this.store.version&&!this.stage.dirty)&&(this.version=this.store.version,this.stage.draw()))}expose(){window.poise={drawn:(e,t=0)=>this.shown instanceof No&&this.shown.device.id===e?this.shown.drawn(t):this.shown instanceof So?this.shown.drawn(e):null,ends:e=>this.shown instanceof No?this.shown.ends(e):null,redraws:()=>this.stage.redraws,painted:()=>this.version,store:this.store,playhead:this.playhead}}};function WT(){let i=`${location.origin.replace(/^http/,"ws")}/ws/device/NAME`;return F("section",{class:"empty"},F("h2",{},"No device yet"),F("p",{},"A device appears here with its first sample. It pushes to"),F("p",{},F("code",{},i)),F("p",{},"or is named when the server is started:"),F("p",{},F("code",{},"poise live serial:/dev/ttyUSB0"),F("code",{},"poise live udp::9000"),F("code",{},"poise live replay:walk.csv"),F("code",{},"poise live sim:balance")))}function XT(i){if(!i.startsWith("#/"))return"";try{return decodeURIComponent(i.slice(2))}catch{return""}}df();new tp(new URLSearchParams(location.search).has("view")?new qs:new Nh);
